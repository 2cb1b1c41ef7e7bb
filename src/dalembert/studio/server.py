"""The server of the studio: the page, and a socket for each tab. It listens on this machine only."""

from __future__ import annotations

import asyncio
import contextlib
import json
from collections.abc import AsyncIterator, Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.websockets import WebSocket, WebSocketDisconnect

from dalembert.arrays import Tree
from dalembert.errors import DalembertError, ModelError
from dalembert.studio.access import LARGEST, TABS, Access, Rate
from dalembert.studio.solver import ASKED, Solver
from dalembert.studio.tab_messages import read_message, sentence

if TYPE_CHECKING:
    from dalembert.studio.session import Session
    from dalembert.studio.solver import Question

BUNDLE = Path(__file__).with_name("bundle")
FILES = {"/": ("index.html", "text/html"), "/studio.js": ("studio.js", "text/javascript")}
LOOK = 0.7
"""Seconds between looks at the disk: what was typed is on disk within two."""
PATIENCE = 5.0
"""Seconds in which a tab reads a message."""
QUESTIONS = 4
"""Questions of a tab that may wait for their answers."""
QUIET = {"pull", "problems", "keys"}
"""Messages after which the state is not sent."""
REFUSED = 4403
"""Code with which a socket is closed that may not speak."""


class StudioServer:
    """One session, its tabs and its solver.

    begin: returns the session. It runs beside the server, so that the page is served while the model is imported.
    """

    session: Session
    wrong: Exception | None = None
    """The reason why there is no session."""

    def __init__(self, begin: Callable[[], Session], access: Access, solver: Solver | None = None) -> None:
        self.begin, self.access, self.solver = begin, access, solver or Solver()
        self.tabs: dict[WebSocket, int] = {}  # and how many questions of each are not answered
        self._answers = set[asyncio.Task[None]]()
        self._begun, self._wanted, self._free = asyncio.Event(), asyncio.Event(), asyncio.Lock()

    def app(self) -> Starlette:
        """The application."""
        routes = [
            *(Route(path, self.page, methods=["GET"]) for path in FILES),
            WebSocketRoute("/tab", self.tab),
            Route("/{rest:path}", self.nothing),
        ]
        return Starlette(routes=routes, lifespan=self._lifespan)

    async def page(self, request: Request) -> Response:
        """The page and its script."""
        refused = self.access.refused(request.headers)
        if refused:
            return PlainTextResponse(refused, 403, headers=self.access.headers())
        name, kind = FILES[request.url.path]
        return Response((BUNDLE / name).read_bytes(), media_type=kind, headers=self.access.headers())

    async def nothing(self, request: Request) -> Response:
        """Any other address."""
        refused = self.access.refused(request.headers)
        return PlainTextResponse(refused or "there is nothing here", 403 if refused else 404)

    async def tab(self, ws: WebSocket) -> None:
        """One tab, from its token to its end."""
        refused = self.access.refused(ws.headers, socket=True)
        if not refused and len(self.tabs) >= TABS:
            refused = f"the studio is open in {TABS} tabs; close one"
        await ws.accept()
        try:
            known = self.access.knows(await _token(ws))
            if not refused and not known:
                refused = "this address has no token, or an old one; open the one that the command printed"
            if not refused:
                await self._begun.wait()
                refused = sentence(self.wrong) if self.wrong else ""
            if refused:
                await ws.send_text(json.dumps({"refused": refused}))
                await ws.close(REFUSED)
                return
            self.tabs[ws] = 0
            await self._tell_all()
            await self._listen(ws)
        except (WebSocketDisconnect, RuntimeError):
            pass  # the tab is closed
        finally:
            self.tabs.pop(ws, None)

    async def _listen(self, ws: WebSocket) -> None:
        rate = Rate()
        while True:
            text = await _received(ws)
            if len(text) > LARGEST:
                await self._send(ws, {"refused": f"a message has more than {LARGEST} characters"})
                continue
            if rate.too_fast():
                await self._send(ws, {"refused": "too many messages; the studio takes 300 a second"})
                await ws.close(REFUSED)
                return
            await self._message(ws, text)

    async def _message(self, ws: WebSocket, text: str) -> None:
        """The state after a message, then its reply; a fault of the program refuses it, and ends no tab. A question
        is answered later, and holds up nothing."""
        n: object = None
        message: Tree = {}
        before = self.session.analysed
        try:
            read = read_message(text)
            message = read if isinstance(read, dict) else {}
            n, ask = message.get("n"), message.get("ask")
            if isinstance(ask, str) and ask in ASKED:
                self._ask(ws, n, ask)
                return
            reply = self.session.handle(message)
        except Exception as error:
            reply = {"refused": sentence(error)}
        await self._reply(ws, {"n": n, **reply}, before != self.session.analysed, bool(QUIET & set(message)))

    async def _reply(self, ws: WebSocket, reply: Tree, changed: bool, quiet: bool) -> None:
        """Send the state to all tabs, after a refusal to the sender alone, and then the reply to the sender."""
        alone = "refused" in reply and not changed
        if quiet and not alone:
            await self._send(ws, reply)
            return
        state = self.session.state()
        others = [] if alone else [tab for tab in self.tabs if tab is not ws]
        if changed:
            self._wanted.set()
        await asyncio.gather(self._send(ws, state, reply), *(self._send(tab, state) for tab in others))

    def _ask(self, ws: WebSocket, n: object, ask: str) -> None:
        """Begin to answer a question of a tab; raises ModelError where it has too many."""
        if self.tabs.get(ws, 0) >= QUESTIONS:
            raise ModelError("earlier questions are not yet answered", "wait for their answers")
        question = self.session.question(ask)
        if ws in self.tabs:
            self.tabs[ws] += 1

        async def answer() -> None:
            try:
                answer_text = await self._solved(question)
            except Exception as error:
                answer_text = json.dumps({"error": sentence(error)})
            if ws in self.tabs:
                self.tabs[ws] -= 1
            await self._send_text(ws, joined({"n": n, "ask": ask, "of": question.of}, answer_text))

        task = asyncio.create_task(answer())
        self._answers.add(task)
        task.add_done_callback(self._answers.discard)

    async def _solved(self, question: Question) -> str:
        """The answer of the solver, which takes one question after the other."""
        async with self._free:
            return await asyncio.to_thread(self.solver.ask, question)

    async def _tell_all(self, changed: bool = True) -> None:
        state = self.session.state()
        await asyncio.gather(*(self._send(ws, state) for ws in self.tabs))
        if changed:
            self._wanted.set()

    async def _send(self, ws: WebSocket, *messages: Tree) -> None:
        for message in messages:
            await self._send_text(ws, json.dumps(message, separators=(",", ":"), default=float))

    async def _send_text(self, ws: WebSocket, text: str) -> None:
        """Sends to a tab; one that does not read in time is no longer told anything."""
        try:
            await asyncio.wait_for(ws.send_text(text), PATIENCE)
        except TimeoutError:
            self.tabs.pop(ws, None)
        except (WebSocketDisconnect, RuntimeError):
            pass  # the tab is closed

    async def _run(self) -> None:
        """The session, from its beginning on."""
        try:
            self.session = await asyncio.to_thread(self.begin)
        except Exception as error:  # a fault of the program too is told to the tabs
            self.wrong = error
        self._begun.set()
        if self.wrong is None:
            await asyncio.gather(self._solve(), self._look())

    async def _solve(self) -> None:
        """Forces of the latest text; those of overtaken ones are not sent. A fault of the program is the answer."""
        while True:
            await self._wanted.wait()
            self._wanted.clear()
            analysed, digest = self.session.analysed, self.session.document.hash
            try:
                answer = await self._answer(self.session)
            except Exception as error:
                answer = json.dumps({"missing": sentence(error)})
            if analysed == self.session.analysed:  # a text that has come meanwhile is solved next
                solved = joined({"hash": digest, "of": analysed}, answer)
                await asyncio.gather(*(self._send_text(ws, solved) for ws in self.tabs))

    async def _answer(self, session: Session) -> str:
        """Forces of the present text in JSON, or what is missing."""
        reading = session.document.reading
        if reading.error or reading.alone or reading.mechanism is None:
            return json.dumps({"missing": "" if reading.error else "Draw a link: press B and drag."})
        answer, _ = await asyncio.gather(
            self._solved(session.question("data")),
            asyncio.to_thread(session.document.prepare),
        )
        return answer

    async def _look(self) -> None:
        """Look at the disk from time to time; why that fails is said as long as it does."""
        while True:
            await asyncio.sleep(LOOK)
            before, seen = self.session.analysed, False
            try:
                seen = self.session.look()
            except Exception as error:
                refused = {"refused": sentence(error)}
                await asyncio.gather(*(self._send(ws, refused) for ws in self.tabs))
            changed = before != self.session.analysed
            if seen or changed:
                await self._tell_all(changed)

    @contextlib.asynccontextmanager
    async def _lifespan(self, _: Any) -> AsyncIterator[None]:
        running = asyncio.create_task(self._run())
        try:
            yield
        finally:
            running.cancel()
            with contextlib.suppress(DalembertError, AttributeError):
                self.session.look()
            self.solver.close()


def joined(head: Tree, answer: str) -> str:
    """A message: its head, and an answer in JSON."""
    return json.dumps(head, separators=(",", ":"))[:-1] + "," + answer[1:]


async def _received(ws: WebSocket) -> str:
    """The next message of a tab; one of bytes as text too."""
    message = await ws.receive()
    if message["type"] == "websocket.disconnect":
        raise WebSocketDisconnect(message.get("code", 1000))
    return str(message.get("text") or (message.get("bytes") or b"").decode("utf-8", "replace"))


async def _token(ws: WebSocket) -> object:
    """The first message, which has to come soon and be short."""
    try:
        text = await asyncio.wait_for(_received(ws), 5.0)
        return read_message(text[:1000]).get("token")
    except (TimeoutError, DalembertError, AttributeError):
        return None

"""The start of the studio: the page is served first, while the model and the solver are imported beside it."""

from __future__ import annotations

import socket
import warnings
import webbrowser
from pathlib import Path
from typing import TYPE_CHECKING

from dalembert.errors import ModelError
from dalembert.studio.access import HOST, LARGEST, Access
from dalembert.studio.solver import Solver, collect_rarely

if TYPE_CHECKING:
    from dalembert.studio.session import Session


def run(path: Path | None, port: int = 0, browser: bool = True) -> None:
    """Serve one file until Ctrl+C; prints the address and opens it. Raises ModelError for one that cannot be read."""
    try:
        listening = socket.create_server((HOST, port))
    except (OSError, OverflowError):
        raise ModelError(f"port {port} cannot be used", "choose another one, or leave --port out") from None
    warnings.simplefilter("ignore", RuntimeWarning)  # of texts half typed; the page has the sentence
    solver = Solver()
    solver.start()
    access, file = Access(listening.getsockname()[1]), path or unused_name(Path.cwd())
    print(f"Studio of {file.name}: {access.address}\nCtrl+C ends it.", flush=True)
    if browser:
        webbrowser.open(access.address)
    import uvicorn

    from dalembert.studio.server import StudioServer

    def begin() -> Session:
        from dalembert.studio.session import Session
        from dalembert.studio.stored_file import StoredFile

        try:
            session = Session(StoredFile(file))
        except ModelError:
            server.should_exit = True
            raise
        collect_rarely()
        return session

    studio = StudioServer(begin, access, solver)
    config = uvicorn.Config(
        studio.app(),
        log_level="error",
        access_log=False,
        ws="websockets-sansio",
        ws_max_size=LARGEST,
        timeout_graceful_shutdown=1,
    )
    server = uvicorn.Server(config)
    server.run(sockets=[listening])
    if studio.wrong is not None:
        raise studio.wrong


def unused_name(folder: Path) -> Path:
    """The file of a new mechanism: a name that is free."""
    names = (f"mechanism{'' if n == 1 else f'_{n}'}.yaml" for n in range(1, 10_000))
    return next(p for name in names if not (p := folder / name).exists())

"""Who may speak to the studio: this machine, by the address that the command printed."""

from __future__ import annotations

import hmac
import secrets
from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass, field
from time import monotonic

LARGEST = 1_000_000
"""Bytes of a message."""
TABS = 8
"""Connections at a time."""
FASTEST = 300
"""Messages of a tab in a second."""
HOST = "127.0.0.1"

POLICY = (
    "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; img-src data: blob:; "
    "connect-src 'self' ws://{host}; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
"""Policy of the page: no other source, and only the socket of the page."""


@dataclass(frozen=True)
class Access:
    """The port and the token of one run."""

    port: int
    token: str = field(default_factory=lambda: secrets.token_urlsafe(32), repr=False)

    @property
    def hosts(self) -> tuple[str, str]:
        """The two names of this server."""
        return f"{HOST}:{self.port}", f"localhost:{self.port}"

    @property
    def address(self) -> str:
        """The address to open; its fragment is sent to no server."""
        return f"http://{self.hosts[0]}/#{self.token}"

    def refused(self, headers: Mapping[str, str], socket: bool = False) -> str:
        """The reason why a request is refused; empty if it is not."""
        host, origin = headers.get("host", ""), headers.get("origin", "")
        if host not in self.hosts:
            return f"this server is {self.hosts[0]}, not {host[:60]!r}"
        if origin and origin not in {f"http://{name}" for name in self.hosts}:
            return f"pages of {origin[:60]!r} may not speak to this server"
        if socket and not origin:
            return "the origin of the page is missing"
        return ""

    def knows(self, token: object) -> bool:
        """True for the token of this run."""
        return isinstance(token, str) and hmac.compare_digest(token.encode(), self.token.encode())

    def headers(self) -> dict[str, str]:
        """Headers of every answer."""
        return {
            "content-security-policy": POLICY.format(host=self.hosts[0]),
            "x-content-type-options": "nosniff",
            "referrer-policy": "no-referrer",
            "cache-control": "no-store",
            "cross-origin-resource-policy": "same-origin",
        }


class Rate:
    """Counts the messages of one tab."""

    def __init__(self) -> None:
        self._times: deque[float] = deque(maxlen=FASTEST)

    def too_fast(self) -> bool:
        """Counts one message; True if there were too many within a second."""
        now = monotonic()
        full = len(self._times) == FASTEST and now - self._times[0] < 1.0
        self._times.append(now)
        return full

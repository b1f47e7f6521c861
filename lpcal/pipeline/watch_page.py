"""The page of ``lpcal watch``, on loopback alone."""

from __future__ import annotations

import json
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

from lpcal.errors import UsageError
from lpcal.report.page_data import WatchData
from lpcal.report.side_pages import watch_html

LOOPBACK = "127.0.0.1"


@contextmanager
def served(state: Callable[[], WatchData], port: int | None) -> Iterator[str | None]:
    """Serve the page to this machine alone; its address, or None without a port.

    Parameters
    ----------
    state : callable
        What the page shows at that moment; it is asked by another thread.
    port : int or None
        0: any that is free.

    Raises
    ------
    UsageError
        The port is taken.
    """
    if port is None:
        yield None
        return

    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            host = (self.headers.get("Host") or "").rpartition(":")[0]
            if host not in {LOOPBACK, "localhost"}:  # a page of elsewhere that calls itself by another name
                self.send_error(403)
            elif self.path == "/state.json":
                self._send("application/json", json.dumps(state(), allow_nan=False))
            elif self.path == "/":
                self._send("text/html; charset=utf-8", watch_html(state()))
            else:
                self.send_error(404)

        def _send(self, media: str, text: str) -> None:
            content = text.encode("utf-8")
            self.send_response(200)
            self.send_header("Content-Type", media)
            self.send_header("Content-Length", str(len(content)))
            self.send_header("Cache-Control", "no-store")
            self.end_headers()
            self.wfile.write(content)

        def log_message(self, *_: Any) -> None:
            """Say nothing."""

    try:
        server = ThreadingHTTPServer((LOOPBACK, port), Handler)
    except (OSError, OverflowError) as error:
        raise UsageError(f"port {port} cannot be used: {error}", where="--port", needed="a free port, or 0 for any") from error
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        yield f"http://{LOOPBACK}:{server.server_address[1]}/"
    finally:
        server.shutdown()
        server.server_close()

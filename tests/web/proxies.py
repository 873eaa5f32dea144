"""A proxy as shops have it: it passes everything below a prefix on, and strips the prefix or not."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from http.client import HTTPConnection
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from urllib.parse import urlsplit

HOP = {"connection", "keep-alive", "transfer-encoding", "te", "trailer", "upgrade", "proxy-connection"}
"""Headers of one connection only."""


@contextmanager
def proxied(port: int, behind: str, prefix: str, strips: bool) -> Iterator[str]:
    """The address of what is served at `behind`, as it is called from outside; what is not below the prefix is not there.

    Parameters
    ----------
    port : int
        Where the proxy listens.
    behind : str
        `http://127.0.0.1:8347`.
    prefix : str
    strips : bool
    """

    class Handler(BaseHTTPRequestHandler):
        protocol_version = "HTTP/1.1"

        def do_GET(self) -> None:
            self._pass()

        def do_POST(self) -> None:
            self._pass()

        def _pass(self) -> None:
            if not self.path.startswith(f"{prefix}/"):
                self.send_error(502, "not below the prefix")
                return
            body = self.rfile.read(int(self.headers.get("Content-Length") or 0))
            headers = {name: value for name, value in self.headers.items() if name.lower() not in HOP}
            with closing(HTTPConnection(urlsplit(behind).netloc, timeout=30)) as inner:
                inner.request(self.command, self.path[len(prefix) :] if strips else self.path, body or None, headers)
                answer = inner.getresponse()
                content = answer.read()
            self.send_response(answer.status)
            for name, value in answer.getheaders():
                if name.lower() not in HOP | {"content-length", "date", "server"}:
                    self.send_header(name, value)
            self.send_header("Content-Length", str(len(content)))
            with suppress(BrokenPipeError, ConnectionResetError):  # the browser went on before the page had come
                self.end_headers()
                self.wfile.write(content)

        def log_message(self, *_: object) -> None:
            """Nothing is told at the terminal."""

    server = ThreadingHTTPServer(("127.0.0.1", port), Handler)
    server.daemon_threads = True
    thread = threading.Thread(target=server.serve_forever, args=(0.05,), daemon=True)
    thread.start()
    try:
        yield f"http://127.0.0.1:{port}{prefix}"
    finally:
        server.shutdown()
        server.server_close()
        thread.join()

"""Messages that are not those of the protocol: each is answered with an error of JSON-RPC, and the
server goes on.
"""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from threading import Timer

import pytest

from tests.command import environment_of

pytest.importorskip("pygls")

LIMIT = 60
"""Seconds after which a server that has not answered is killed, which fails its tests."""

HOVER = "textDocument/hover"
DOCUMENT = {"uri": "file:///a.msaa.yaml"}

PARSE_ERROR, INVALID_REQUEST, METHOD_NOT_FOUND, INVALID_PARAMS = -32700, -32600, -32601, -32602


def message(identifier: object, method: object, params: object) -> bytes:
    return json.dumps(
        {"jsonrpc": "2.0", "id": identifier, "method": method, "params": params}
    ).encode()


class Conversation:
    """A server, and what it is sent byte for byte."""

    def __init__(self, process: subprocess.Popen[bytes]) -> None:
        assert process.stdin is not None and process.stdout is not None
        self.process, self.stdin, self.stdout = process, process.stdin, process.stdout

    def send(self, body: bytes) -> None:
        self.stdin.write(b"Content-Length: %d\r\n\r\n%s" % (len(body), body))
        self.stdin.flush()

    def answer(self) -> dict[str, object]:
        length = 0
        while (header := self.stdout.readline()) != b"\r\n":
            assert header, "the server ended"
            name, _, value = header.partition(b":")
            length = int(value) if name == b"Content-Length" else length
        found = json.loads(self.stdout.read(length))
        assert isinstance(found, dict)
        return found

    def ask(self, body: bytes) -> dict[str, object]:
        """The answer to a message; requests of the server, which begin with an identifier of its
        own, are not in this conversation.
        """
        self.send(body)
        return self.answer()


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> object:
    folder: Path = tmp_path_factory.mktemp("messages")
    command = [sys.executable, "-m", "msaa_lint", "lsp"]
    with subprocess.Popen(
        command, cwd=folder, env=environment_of({}), stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as process:
        timer = Timer(LIMIT, process.kill)
        timer.start()
        conversation = Conversation(process)
        answer = conversation.ask(
            message(0, "initialize", {"capabilities": {}, "processId": None, "rootUri": None})
        )
        assert "result" in answer
        yield conversation
        assert conversation.ask(message(1, "shutdown", None)) == {
            "jsonrpc": "2.0",
            "id": 1,
            "result": None,
        }
        assert error(
            conversation.ask(
                message(
                    2, HOVER, {"textDocument": DOCUMENT, "position": {"line": 0, "character": 0}}
                )
            )
        ) == (
            2,
            INVALID_REQUEST,
        )
        conversation.send(b'{"jsonrpc": "2.0", "method": "exit"}')
        assert process.wait(LIMIT) == 0
        timer.cancel()


def error(answer: dict[str, object]) -> tuple[object, object]:
    assert "result" not in answer and isinstance(answer["error"], dict)
    return answer.get("id"), answer["error"]["code"]


def position(line: object, character: object) -> dict[str, object]:
    return {"textDocument": DOCUMENT, "position": {"line": line, "character": character}}


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        (message(7, HOVER, position("first", 0)), (7, INVALID_PARAMS)),
        (message(7, HOVER, position(-1, 0)), (7, INVALID_PARAMS)),
        (message(7, HOVER, position(1 << 40, 0)), (7, INVALID_PARAMS)),
        (message("seven", HOVER, {"textDocument": DOCUMENT}), ("seven", INVALID_PARAMS)),
        (message(7, HOVER, [1, 2]), (7, INVALID_PARAMS)),
        (message(7, HOVER, None), (7, INVALID_PARAMS)),
        (b'{"jsonrpc": "2.0", "id": 7, "method": "textDocument/hover"}', (7, INVALID_PARAMS)),
        (message(7, "textDocument/rename", position(0, 0)), (7, INVALID_PARAMS)),
        (
            message(7, "textDocument/codeAction", {"textDocument": DOCUMENT, "range": 3}),
            (7, INVALID_PARAMS),
        ),
        (message(7, "codeAction/resolve", {"kind": 3}), (7, INVALID_PARAMS)),
        (message(7, "textDocument/never", {}), (7, METHOD_NOT_FOUND)),
        (b'{"jsonrpc": "2.0", "id": 7, "method": "textDocument/never"}', (7, METHOD_NOT_FOUND)),
        (message([7], HOVER, position(0, 0)), (None, INVALID_REQUEST)),
        (b'{"id": 7, "method": "textDocument/hover"}', (7, INVALID_REQUEST)),
        (b"[]", (None, INVALID_REQUEST)),
        (b"3", (None, INVALID_REQUEST)),
        (b'{"jsonrpc": "2.0", "id": 7,', (None, PARSE_ERROR)),
        (b"\xff\xfe", (None, PARSE_ERROR)),
        (b"[" * 100_000, (None, PARSE_ERROR)),
    ],
)
def test_what_is_not_a_message_is_an_error(
    server: Conversation, body: bytes, expected: tuple[object, int]
) -> None:
    assert error(server.ask(body)) == expected


def test_the_error_names_the_parameter(server: Conversation) -> None:
    answer = server.ask(message(7, HOVER, position("first", 0)))
    assert isinstance(answer["error"], dict)
    assert "position.line" in answer["error"]["message"] and "Traceback" not in json.dumps(answer)


def test_a_notification_that_cannot_be_read_has_no_answer(server: Conversation) -> None:
    for params in (
        None,
        [],
        {"textDocument": 3},
        {"textDocument": {"uri": "a", "version": "x"}, "contentChanges": {}},
    ):
        server.send(
            json.dumps(
                {"jsonrpc": "2.0", "method": "textDocument/didChange", "params": params}
            ).encode()
        )
    assert server.ask(message(8, HOVER, position(0, 0))) == {
        "jsonrpc": "2.0",
        "id": 8,
        "result": None,
    }

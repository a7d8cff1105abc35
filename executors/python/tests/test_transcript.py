"""The executor against servers that say what they are told to, over real sockets."""

import asyncio
import json
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import Any

import pytest
from websockets.asyncio.server import Server, ServerConnection, serve
from websockets.exceptions import ConnectionClosed
from websockets.http11 import Request, Response
from websockets.typing import Subprotocol

from goalgraph_executor import Executor, Refused, SubGoal, Unavailable

Message = dict[str, Any]
DOCS = Path(__file__).parents[3] / "docs"
TRANSCRIPT = [json.loads(line) for line in (DOCS / "executor-session.jsonl").read_text().splitlines()]
SPECIFICATION: Message = TRANSCRIPT[2]["message"]
WELCOME: Message = TRANSCRIPT[1]["message"]


class HiddenRed:
    """Cannot complete red; everything else is completed at once."""

    async def achieve(self, sub_goal: SubGoal) -> None:
        await asyncio.sleep(0)
        if sub_goal.name == "red":
            raise Unavailable


def comparable(message: Message, run: str) -> Message:
    """Without what differs from one robot and one day to another."""
    kept = {key: value for key, value in message.items() if key not in ("at_ms", "software")}
    return kept | {"run": run} if "run" in kept else kept


async def hear(socket: ServerConnection) -> Message:
    """The next message that is no heartbeat."""
    while True:
        message: Message = json.loads(await socket.recv())
        if message["type"] != "heartbeat":
            return message


async def say(socket: ServerConnection, message: Message) -> None:
    await socket.send(json.dumps(message))


async def run_against(script: Callable[[ServerConnection], Awaitable[None]], **options: Any) -> None:
    """Serves every connection by the script while an executor does its one run."""
    failures: list[BaseException] = []

    async def handle(socket: ServerConnection) -> None:
        try:
            await script(socket)
        except ConnectionClosed:
            pass
        except BaseException as error:
            failures.append(error)
            raise

    async with serve(handle, "127.0.0.1", 0, subprotocols=[Subprotocol("goalgraph.executor.v1")]) as server:
        await asyncio.wait_for(Executor(url_of(server), "cell 4", HiddenRed(), **options).serve(runs=1), 20)
    assert not failures


def url_of(server: Server) -> str:
    host, port = next(iter(server.sockets)).getsockname()[:2]
    return f"ws://{host}:{port}"


def connections() -> list[list[Message]]:
    """The lines of the transcript, by connection: each begins with a hello."""
    starts = [index for index, line in enumerate(TRANSCRIPT) if line["message"]["type"] == "hello"]
    return [TRANSCRIPT[start:end] for start, end in zip(starts, [*starts[1:], None])]


def test_the_executor_says_what_the_transcript_says_and_goes_on_after_a_lost_connection() -> None:
    ahead = connections()
    run = ""

    async def script(socket: ServerConnection) -> None:
        nonlocal run
        for line in ahead.pop(0):
            message = line["message"]
            if line["from"] == "server":
                await say(socket, comparable(message, run))
                continue
            said = await hear(socket)
            run = said["run"] if said["type"] == "begin" else run
            assert comparable(said, run) == comparable(message, run)
        if not ahead:
            await socket.wait_closed()

    asyncio.run(run_against(script))
    assert not ahead


def test_what_was_tampered_with_or_is_stale_is_rejected_and_never_run() -> None:
    heard: list[Message] = []

    async def script(socket: ServerConnection) -> None:
        await hear(socket)
        await say(socket, WELCOME)
        await say(socket, SPECIFICATION | {"content": SPECIFICATION["content"].replace("Blue", "Pink")})
        heard.append(await hear(socket))
        await say(socket, SPECIFICATION | {"approval": 5})
        heard.append(await hear(socket))
        await say(socket, SPECIFICATION)
        heard.append(await hear(socket))
        await say(socket, {"type": "command", "command": "start"})
        await socket.close(4000, "that is enough")

    with pytest.raises(Refused, match="that is enough"):
        asyncio.run(run_against(script))
    assert [message["type"] for message in heard] == ["rejected", "accepted", "rejected"]
    assert heard[0]["sha256"] == SPECIFICATION["sha256"]
    assert heard[0]["reason"].startswith("the content has the SHA-256 ")
    assert heard[2]["reason"] == "approval 1 is older than approval 5, which was accepted"


def test_a_token_that_is_refused_is_said_and_not_tried_again() -> None:
    asked: list[str | None] = []

    def refuse(connection: ServerConnection, request: Request) -> Response:
        asked.append(request.headers.get("Authorization"))
        return connection.respond(401, "this token was revoked")

    async def run() -> None:
        async def handle(socket: ServerConnection) -> None:
            raise AssertionError("the connection was refused")

        async with serve(handle, "127.0.0.1", 0, process_request=refuse) as server:
            await Executor(url_of(server), "cell 4", HiddenRed(), token="goalgraph_a_b").serve()

    with pytest.raises(Refused, match="HTTP status 401 this token was revoked"):
        asyncio.run(run())
    assert asked == ["Bearer goalgraph_a_b"]


def test_what_the_server_could_not_take_is_sent_again() -> None:
    sent: list[int] = []

    async def script(socket: ServerConnection) -> None:
        await hear(socket)
        await say(socket, WELCOME | {"heartbeat_ms": 100})
        await say(socket, SPECIFICATION)
        await hear(socket)
        run = (await hear(socket))["run"]
        await say(socket, {"type": "granted", "run": run, "stored": 0})
        sent.append((await hear(socket))["number"])
        await say(socket, {"type": "refused", "reason": "unavailable", "message": "disk full", "run": run})
        await say(socket, {"type": "heartbeat"})
        while sent[1:].count(1) == 0:
            sent.append((await hear(socket))["number"])
        for number in range(1, 10):
            await say(socket, {"type": "acknowledged", "run": run, "number": number})
            if number < 9:
                sent.append((await hear(socket))["number"])
        await socket.wait_closed()

    asyncio.run(run_against(script, auto=True))
    assert sent[-9:] == [1, 2, 3, 4, 5, 6, 7, 8, 9]

"""The connection to the server: `goalgraph.executor.v1`, as docs/executor-protocol.md describes it."""

from __future__ import annotations

import asyncio
import json
import logging
import random
import time
import uuid
from typing import Any
from urllib.parse import quote, urlsplit, urlunsplit

from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.typing import Subprotocol

from .run import Robot, Run
from .specification import Specification, Tampered

SUBPROTOCOL = Subprotocol("goalgraph.executor.v1")
REPLACED, REVOKED = 4000, 4001
log = logging.getLogger("goalgraph_executor")


class Refused(Exception):
    """The server does not take this executor (any more)."""


class Executor:
    """Follows the approved specification with a robot; with `auto` it begins runs without being told to."""

    def __init__(
        self, url: str, name: str, robot: Robot, *, token: str | None = None, specification: str | None = None, auto: bool = False
    ) -> None:
        scheme, host, path, query, _ = urlsplit(url)
        wanted = f"specification={quote(specification, safe='')}" if specification else ""
        self.url = urlunsplit((scheme, host, path.rstrip("/") or "/api/v1/executor", "&".join(filter(None, (query, wanted))), ""))
        self.name, self.robot, self.token, self.auto = name, robot, token, auto
        self.run: Run | None = None
        self.specification: Specification | None = None
        self._runs_over, self._runs_wanted = 0, 0
        self._approvals: dict[str, int] = {}
        self._unstored: list[tuple[int, dict[str, Any]]] = []
        self._granted, self._put_off = False, False
        self._heartbeat_s, self._lease_s, self._leased_until = 5.0, 15.0, 0.0
        self._outgoing: asyncio.Queue[dict[str, Any]] = asyncio.Queue()
        self._work: asyncio.Task[None] | None = None

    async def serve(self, runs: int = 0) -> None:
        """Stays connected until so many runs are over and stored; 0 is for ever. Raises `Refused`."""
        self._runs_wanted = runs
        headers = {"Authorization": f"Bearer {self.token}"} if self.token else {}
        watch = asyncio.create_task(self._watch_lease())
        try:
            async for socket in connect(self.url, subprotocols=[SUBPROTOCOL], additional_headers=headers, max_size=None):
                if socket.subprotocol != SUBPROTOCOL:
                    raise Refused(f"{self.url} does not speak {SUBPROTOCOL}")
                if await self._talk(socket):
                    return await socket.close()
                await asyncio.sleep(random.uniform(0.1, 0.5))
        except InvalidStatus as answer:
            detail = (answer.response.body or b"").decode(errors="replace")
            raise Refused(f"{self.url}: HTTP status {answer.response.status_code} {detail}".strip()) from answer
        finally:
            watch.cancel()
            if self._work:
                self._work.cancel()

    async def _talk(self, socket: ClientConnection) -> bool:
        """One connection; whether there is nothing left to do."""
        self._outgoing = asyncio.Queue()
        self._send("hello", executor=self.name, software="goalgraph-executor 0.1.0 (Python)")
        tasks = [asyncio.create_task(self._write(socket)), asyncio.create_task(self._beat())]
        try:
            async for text in socket:
                self._heard(json.loads(text))
                if self._runs_wanted and self._runs_over >= self._runs_wanted:
                    return True
        except ConnectionClosed:
            pass
        finally:
            for task in tasks:
                task.cancel()
            self._granted = False
            self.specification = None
        if socket.close_code in (REPLACED, REVOKED):
            raise Refused(socket.close_reason or f"the server closed the connection with {socket.close_code}")
        log.info("the connection was lost: %s %s", socket.close_code, socket.close_reason)
        return False

    async def _write(self, socket: ClientConnection) -> None:
        while True:
            await socket.send(json.dumps(await self._outgoing.get()))

    async def _beat(self) -> None:
        while True:
            await asyncio.sleep(self._heartbeat_s / 2)
            self._send("heartbeat")

    async def _watch_lease(self) -> None:
        while True:
            await asyncio.sleep(self._lease_s / 20)
            if self.run and time.monotonic() > self._leased_until:
                self.run.hold_lease(False)

    def _heard(self, message: dict[str, Any]) -> None:
        if self._granted:
            self._leased_until = time.monotonic() + self._lease_s
        mine = self.run is not None and message.get("run") == self.run.id
        match message["type"]:
            case "welcome":
                self._heartbeat_s, self._lease_s = message["heartbeat_ms"] / 1000, message["lease_ms"] / 1000
                self._ask()
            case "specification":
                self._consider(message)
            case "withdrawn":
                self.specification = None
            case "granted" if mine:
                self._grant(message["stored"])
            case "acknowledged" if mine:
                self._stored(message["number"])
            case "denied" if mine:
                self._give_up(message["message"])
            case "command":
                self._obey(message["command"])
            case "heartbeat" if self._put_off:
                self._put_off = False
                self._send_from(1) if self._granted else self._ask()
            case "refused":
                log.warning("refused: %s", message["message"])
                if message.get("run") is None or mine:
                    self._refused(message)

    def _consider(self, message: dict[str, Any]) -> None:
        try:
            last = self._approvals.get(message["specification"], 0)
            if message["approval"] < last:
                raise Tampered(f"approval {message['approval']} is older than approval {last}, which was accepted")
            specification = Specification.read(message["content"], message["sha256"], message["revision"])
        except Tampered as error:
            log.warning("rejected r%s: %s", message["revision"], error)
            self.specification = None
            return self._send("rejected", sha256=message["sha256"], reason=str(error))
        self.specification = specification
        self._approvals[message["specification"]] = message["approval"]
        self._send("accepted", sha256=specification.sha256)
        if self.auto and self.run is None:
            self._begin()

    def _obey(self, command: str) -> None:
        if command == "start" and self.run is None:
            self._begin()
        elif self.run and command == "stop":
            self.run.end("stopped")
        elif self.run and command in ("pause", "resume"):
            self.run.pause() if command == "pause" else self.run.resume()

    def _begin(self) -> None:
        if self.specification:
            self.run = Run(str(uuid.uuid4()), self.specification, self._report)
            self._ask()

    def _ask(self) -> None:
        if self.run:
            self._send("begin", run=self.run.id, sha256=self.run.specification.sha256)

    def _grant(self, stored: int) -> None:
        assert self.run
        if stored > self.run.events:
            return self._give_up(f"the server has {stored} events, but only {self.run.events} happened here")
        self._granted, self._leased_until = True, time.monotonic() + self._lease_s
        self.run.hold_lease(True)
        self._stored(stored)
        self._send_from(stored + 1)
        if self.run and self._work is None:
            self._work = asyncio.create_task(self.run.work(self.robot))

    def _report(self, number: int, happened: dict[str, Any]) -> None:
        log.info("%s %s", number, happened)
        self._unstored.append((number, {"at_ms": int(time.time() * 1000), "happened": happened}))
        if self._granted:
            self._send_from(number)

    def _send_from(self, first: int) -> None:
        for number, event in self._unstored:
            if self.run and number >= first:
                self._send("event", run=self.run.id, number=number, **event)

    def _stored(self, last: int) -> None:
        self._unstored = [event for event in self._unstored if event[0] > last]
        if self.run and self.run.over and not self._unstored:
            self._let_go()

    def _refused(self, message: dict[str, Any]) -> None:
        match message["reason"]:
            case "gap":
                self._send_from(message.get("expected", 1))
            case "no_lease":
                self._ask()
            case "conflict" | "over":
                self._give_up(message["message"])
            case "too_many" | "unavailable":
                self._put_off = True

    def _give_up(self, why: str) -> None:
        if self.run:
            log.warning("run %s ends here: %s", self.run.id, why)
            self._let_go()

    def _let_go(self) -> None:
        if self._work:
            self._work.cancel()
        self.run, self._work, self._granted, self._unstored = None, None, False, []
        self._runs_over += 1
        if self.auto and self._runs_over < self._runs_wanted:
            self._begin()

    def _send(self, type: str, **fields: Any) -> None:
        self._outgoing.put_nowait({"type": type, **fields})

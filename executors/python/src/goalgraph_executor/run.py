"""One run: the robot works through a plan, and every step is reported."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Any, Protocol

from .specification import Specification, SubGoal


class Unavailable(Exception):
    """The sub-goal cannot be completed for the time being: the run goes another way, or waits."""


class Failed(Exception):
    """The robot gives up: the run ends."""


class Robot(Protocol):
    """What a robot must be able to do."""

    async def achieve(self, sub_goal: SubGoal) -> None:
        """Returns when the sub-goal is completed; raises `Unavailable` or `Failed`. Canceled when it has to stop."""


class Run:
    """Follows a specification; `report` is handed every event with its number."""

    def __init__(self, id: str, specification: Specification, report: Callable[[int, dict[str, Any]], None]) -> None:
        self.id, self.specification = id, specification
        self.state = specification.initial
        self.unavailable_sub_goals: set[str] = set()
        self.events, self.over, self.planned = 0, False, False
        self._report_event = report
        self._ahead: list[str] = []
        self._outdated, self._complete = True, False
        self._waits_in: str | None = None
        self._active: tuple[str, asyncio.Task[None]] | None = None
        self._wanted, self._leased = asyncio.Event(), asyncio.Event()
        self._changed = asyncio.Event()
        self._wanted.set()

    async def work(self, robot: Robot) -> None:
        """Works until the run is over."""
        while not self.over:
            await self._leased.wait()
            if not self._wanted.is_set():
                self._report("paused")
                await self._wanted.wait()
                if not self.over:
                    self._report("resumed")
                    self._waits_in = None
                continue
            sub_goal = self._next()
            if sub_goal is not None:
                await self._achieve(robot, sub_goal)
            elif not self.over:
                self._changed.clear()
                await self._changed.wait()

    def completed(self, sub_goal: str) -> None:
        """A sub-goal is completed, whether or not it was the one worked on."""
        if self.over:
            return
        self._report("completed", sub_goal=sub_goal)
        target = self.specification.target(self.state, sub_goal)
        if target is None:
            return self.end("failed", reason=f"{sub_goal} was completed in {self.state}, where there is no way for it")
        self.state = target
        if self._ahead[:1] == [sub_goal]:
            del self._ahead[0]
        else:
            self._outdate(cancel=True)

    def unavailable(self, sub_goal: str, reason: str | None = None) -> None:
        """A sub-goal cannot be completed for the time being."""
        if sub_goal not in self.unavailable_sub_goals and not self.over:
            self.unavailable_sub_goals.add(sub_goal)
            self._report("unavailable", sub_goal=sub_goal, **({"reason": reason} if reason else {}))
            if sub_goal in self._ahead:
                self._outdate(cancel=self._active is not None and self._active[0] == sub_goal)

    def available(self, sub_goal: str) -> None:
        """A sub-goal can be completed again; a better way is taken at the next state."""
        if sub_goal in self.unavailable_sub_goals and not self.over:
            self.unavailable_sub_goals.remove(sub_goal)
            self._report("available", sub_goal=sub_goal)
            self._outdate(cancel=False)

    def pause(self) -> None:
        """Pauses before the next sub-goal."""
        self._wanted.clear()
        self._changed.set()

    def resume(self) -> None:
        """Goes on after a pause."""
        self._wanted.set()

    def hold_lease(self, held: bool) -> None:
        """Without the lease the robot stops at once; with it again, it goes on."""
        if held:
            self._leased.set()
        elif self._leased.is_set():
            self._leased.clear()
            self._outdate(cancel=True)

    def end(self, event: str, **fields: Any) -> None:
        """Ends the run: `finished`, `failed` with a reason, or `stopped`."""
        if not self.over:
            self._report(event, **fields)
            self.over = True
            self._wanted.set()
            self._leased.set()
            self._outdate(cancel=True)

    def _next(self) -> str | None:
        if self._outdated:
            plan = self.specification.plan(self.state, self.unavailable_sub_goals)
            self._outdated, self._complete = False, plan.complete
            if plan.word and list(plan.word) != self._ahead:
                event, self.planned = "replanned" if self.planned else "planned", True
                self._report(event, state=self.state, word=list(plan.word), probability=plan.probability)
            self._ahead = list(plan.word)
        if self._ahead:
            self._waits_in = None
            return self._ahead[0]
        if self._complete:
            self.end("finished")
        elif self._waits_in != self.state:
            self._waits_in = self.state
            self._report("waiting", state=self.state)
        return None

    async def _achieve(self, robot: Robot, sub_goal: str) -> None:
        self._report("started", sub_goal=sub_goal)
        task = asyncio.ensure_future(robot.achieve(self.specification.sub_goals[sub_goal]))
        self._active = (sub_goal, task)
        try:
            await asyncio.wait({task})
        finally:
            task.cancel()
            self._active = None
        if self.over or task.cancelled():
            return
        match task.exception():
            case None:
                self.completed(sub_goal)
            case Unavailable() as error:
                self.unavailable(sub_goal, str(error) or None)
            case error:
                self.end("failed", reason=str(error) or repr(error))

    def _outdate(self, cancel: bool) -> None:
        self._outdated = True
        self._changed.set()
        if cancel and self._active:
            self._active[1].cancel()

    def _report(self, event: str, **fields: Any) -> None:
        self.events += 1
        self._report_event(self.events, {"event": event, **fields})

"""What a run reports, whatever happens to the robot."""

import asyncio
from collections.abc import Callable
from typing import Any

from goalgraph_executor import Failed, Run, SubGoal, Unavailable
from test_planning import ENDS, TWO_WAYS, read


class ScriptedRobot:
    """Does for each sub-goal what it is told, and nothing for the others: then they are completed."""

    def __init__(self, script: dict[str, Callable[[], None]]) -> None:
        self.script = script

    async def achieve(self, sub_goal: SubGoal) -> None:
        await asyncio.sleep(0)
        step = self.script.get(sub_goal.id)
        if step:
            step()


def short(event: dict[str, Any]) -> str:
    word = event.get("word")
    return " ".join(filter(None, (event["event"], event.get("sub_goal"), word and ",".join(word), event.get("reason"))))


async def report(script: Callable[[Run], dict[str, Callable[[], None]]], until: str) -> list[str]:
    """The events of a run until one of them is `until`."""
    events: list[str] = []
    reached = asyncio.Event()

    def see(number: int, event: dict[str, Any]) -> None:
        events.append(short(event))
        assert number == len(events)
        if event["event"] == until:
            reached.set()

    run = Run("run", read(TWO_WAYS, ENDS), see)
    run.hold_lease(True)
    work = asyncio.create_task(run.work(ScriptedRobot(script(run))))
    await asyncio.wait_for(reached.wait(), 5)
    if run.over:
        await asyncio.wait_for(work, 5)
    work.cancel()
    return events


def test_a_run_without_trouble_follows_its_first_plan() -> None:
    events = asyncio.run(report(lambda run: {}, "finished"))
    assert events == ["planned g0,g1", "started g0", "completed g0", "started g1", "completed g1", "finished"]


def test_it_goes_another_way_waits_and_goes_on() -> None:
    def script(run: Run) -> dict[str, Callable[[], None]]:
        tries = iter([True, False])

        def red() -> None:
            if next(tries):
                asyncio.get_running_loop().call_later(0.05, run.available, "g0")
                raise Unavailable("hidden")

        return {"g0": red}

    assert asyncio.run(report(script, "finished")) == [
        "planned g0,g1",
        "started g0",
        "unavailable g0 hidden",
        "replanned g1",
        "started g1",
        "completed g1",
        "waiting",
        "available g0",
        "replanned g0",
        "started g0",
        "completed g0",
        "finished",
    ]


def test_a_robot_that_fails_or_breaks_ends_the_run() -> None:
    def fails() -> None:
        raise Failed("the gripper is broken")

    def breaks() -> None:
        raise ZeroDivisionError("division by zero")

    events = asyncio.run(report(lambda run: {"g0": fails}, "failed"))
    assert events == ["planned g0,g1", "started g0", "failed the gripper is broken"]
    assert asyncio.run(report(lambda run: {"g0": breaks}, "failed"))[-1] == "failed division by zero"


def test_a_pause_begins_before_the_next_sub_goal() -> None:
    def script(run: Run) -> dict[str, Callable[[], None]]:
        def pause() -> None:
            run.pause()
            asyncio.get_running_loop().call_later(0.05, run.resume)

        return {"g0": pause}

    events = asyncio.run(report(script, "finished"))
    assert events[2:6] == ["completed g0", "paused", "resumed", "started g1"]


def test_stopping_cancels_what_the_robot_does() -> None:
    events = asyncio.run(report(lambda run: {"g1": lambda: run.end("stopped")}, "stopped"))
    assert events == ["planned g0,g1", "started g0", "completed g0", "started g1", "stopped"]


def test_what_is_completed_by_accident_moves_the_run_on() -> None:
    def script(run: Run) -> dict[str, Callable[[], None]]:
        return {"g0": lambda: None if run.state == "q2" else run.completed("g1")}

    events = asyncio.run(report(script, "finished"))
    assert events[2:] == ["completed g1", "replanned g0", "started g0", "completed g0", "finished"]


def test_without_the_lease_the_robot_stops_at_once_and_goes_on_with_it() -> None:
    def script(run: Run) -> dict[str, Callable[[], None]]:
        times = iter([True, False])

        def lose() -> None:
            if next(times):
                run.hold_lease(False)
                asyncio.get_running_loop().call_later(0.05, run.hold_lease, True)

        return {"g0": lose}

    events = asyncio.run(report(script, "finished"))
    assert events[:4] == ["planned g0,g1", "started g0", "started g0", "completed g0"]

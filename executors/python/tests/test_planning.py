"""Specifications are believed only when they are what they say, and plans follow their probabilities."""

import json
from typing import Any

import pytest

from goalgraph_executor import Specification, Tampered


def content(ways: list[tuple[str, str, str, float]], finals: dict[str, float]) -> str:
    symbols = sorted({symbol for _, symbol, _, _ in ways}, key=lambda symbol: int(symbol[1:]))
    file: dict[str, Any] = {
        "format": "goalgraph-specification",
        "version": 1,
        "name": "Task",
        "sub_goals": [{"id": symbol, "name": symbol} for symbol in symbols],
        "automaton": {
            "initial": "q0",
            "states": [{"id": state, "final_probability": final} for state, final in finals.items()],
            "transitions": [
                {"source": source, "symbol": symbol, "target": target, "probability": probability}
                for source, symbol, target, probability in ways
            ],
        },
    }
    return json.dumps(file)


def read(ways: list[tuple[str, str, str, float]], finals: dict[str, float]) -> Specification:
    text = content(ways, finals)
    return Specification.read(text, Specification.digest(text), 1)


TWO_WAYS = [("q0", "g0", "q1", 0.6), ("q0", "g1", "q2", 0.4), ("q1", "g1", "q3", 1.0), ("q2", "g0", "q3", 1.0)]
ENDS = {"q0": 0.0, "q1": 0.0, "q2": 0.0, "q3": 1.0}


def test_the_most_probable_way_comes_first() -> None:
    plan = read(TWO_WAYS, ENDS).plan("q0", set())
    assert (plan.word, plan.probability, plan.complete) == (("g0", "g1"), 0.6, True)


def test_ties_go_to_the_earlier_symbol_by_number() -> None:
    specification = read([("q0", "g10", "q1", 0.5), ("q0", "g9", "q1", 0.5)], {"q0": 0.0, "q1": 1.0})
    assert specification.plan("q0", set()).word == ("g9",)


def test_it_backs_out_of_a_dead_end() -> None:
    ways = [("q0", "g0", "q1", 0.9), ("q1", "g2", "q3", 1.0), ("q0", "g1", "q2", 0.1), ("q2", "g3", "q3", 1.0)]
    assert read(ways, ENDS).plan("q0", {"g2"}).word == ("g1", "g3")


def test_without_an_end_in_reach_it_goes_as_far_as_possible() -> None:
    plan = read(TWO_WAYS, ENDS).plan("q0", {"g1"})
    assert (plan.word, plan.probability, plan.complete) == (("g0",), 0.6, False)
    assert read(TWO_WAYS, ENDS).plan("q0", {"g0", "g1"}).word == ()


def test_a_way_back_is_not_taken_twice() -> None:
    ways = [("q0", "g0", "q1", 1.0), ("q1", "g1", "q0", 0.5), ("q1", "g2", "q2", 0.5)]
    assert read(ways, {"q0": 0.0, "q1": 0.0, "q2": 1.0}).plan("q0", {"g2"}).word == ("g0",)


def test_content_that_was_changed_is_refused() -> None:
    text = content(TWO_WAYS, ENDS)
    with pytest.raises(Tampered, match="the content has the SHA-256"):
        Specification.read(text.replace("0.6", "0.7"), Specification.digest(text), 1)


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"format": "goalgraph-specification", "version": 2}', "null", "\x00"])
def test_what_is_no_specification_is_refused(text: str) -> None:
    with pytest.raises(Tampered):
        Specification.read(text, Specification.digest(text), 1)

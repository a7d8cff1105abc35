"""The approved specification, and the order of sub-goals that its probabilities prefer."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Set
from dataclasses import dataclass, field


class Tampered(Exception):
    """The content is not what its SHA-256 says, or no specification."""


@dataclass(frozen=True)
class SubGoal:
    """What to bring about; without a place (words only) `center` is empty."""

    id: str
    name: str
    features: tuple[str, ...] = ()
    center: tuple[float, ...] = ()
    radius: float = 0.0


@dataclass(frozen=True)
class Plan:
    """Sub-goals in order; `complete` when the task may end after them, else what can be done meanwhile."""

    word: tuple[str, ...]
    probability: float
    complete: bool


@dataclass
class Specification:
    """An automaton over sub-goals: `ways[state]` has (sub-goal, target, probability), the best first."""

    sha256: str
    name: str
    revision: int
    initial: str
    sub_goals: dict[str, SubGoal]
    ways: dict[str, list[tuple[str, str, float]]]
    finals: dict[str, float]
    live: set[str] = field(default_factory=set)

    @staticmethod
    def read(content: str, sha256: str, revision: int) -> Specification:
        """Checks the SHA-256 and reads the file; raises `Tampered`."""
        received = Specification.digest(content)
        if received != sha256.lower():
            raise Tampered(f"the content has the SHA-256 {received}, not {sha256} as the server says")
        try:
            file = json.loads(content)
            if (file["format"], file["version"]) != ("goalgraph-specification", 1):
                raise Tampered("it is no goalgraph-specification of version 1")
            sub_goals = {
                it["id"]: SubGoal(
                    it["id"], it["name"], tuple(it.get("features", ())), tuple(it.get("center", ())), it.get("radius", 0.0)
                )
                for it in file["sub_goals"]
            }
            automaton = file["automaton"]
            finals = {it["id"]: float(it["final_probability"]) for it in automaton["states"]}
            ways: dict[str, list[tuple[str, str, float]]] = {state: [] for state in finals}
            for it in automaton["transitions"]:
                if it["probability"] > 0 and it["target"] in finals and it["symbol"] in sub_goals:
                    ways[it["source"]].append((it["symbol"], it["target"], float(it["probability"])))
            for out in ways.values():
                out.sort(key=lambda way: (-way[2], int(way[0][1:])))
            found = Specification(received, file["name"], revision, automaton["initial"], sub_goals, ways, finals)
            found.live = found._live()
        except (KeyError, TypeError, ValueError) as error:
            raise Tampered(f"it is no specification: {error!r}") from error
        if found.initial not in found.live:
            raise Tampered("from its initial state no end can be reached")
        return found

    @staticmethod
    def digest(content: str) -> str:
        """SHA-256 of the content, hexadecimal."""
        return hashlib.sha256(content.encode()).hexdigest()

    def plan(self, start: str, unavailable: Set[str]) -> Plan:
        """The most probable available way at each state, backing out of dead ends; else what can be done meanwhile."""
        complete = self._to_an_end(start, unavailable)
        if complete is not None:
            return Plan(complete, self._probability(start, complete, True), True)
        meanwhile = self._as_far_as_possible(start, unavailable)
        return Plan(meanwhile, self._probability(start, meanwhile, False), False)

    def target(self, state: str, sub_goal: str) -> str | None:
        """Where a sub-goal leads from a state; none where the automaton has no way for it."""
        return next((target for symbol, target, _ in self.ways[state] if symbol == sub_goal), None)

    def _available(self, state: str, unavailable: Set[str]) -> Iterator[tuple[str, str]]:
        return ((symbol, target) for symbol, target, _ in self.ways[state] if symbol not in unavailable)

    def _to_an_end(self, start: str, unavailable: Set[str]) -> tuple[str, ...] | None:
        entered, word = {start}, list[str]()
        stack = [self._available(start, unavailable)]
        if self.finals[start] > 0:
            return ()
        while stack:
            way = next(stack[-1], None)
            if way is None:
                stack.pop()
                del word[-1:]
            elif way[1] not in entered:
                entered.add(way[1])
                word.append(way[0])
                if self.finals[way[1]] > 0:
                    return tuple(word)
                stack.append(self._available(way[1], unavailable))
        return None

    def _as_far_as_possible(self, start: str, unavailable: Set[str]) -> tuple[str, ...]:
        """The longest way that keeps an end in reach for when everything is available again."""
        longest: tuple[str, ...] = ()
        word, path = list[str](), [start]
        deepest, stack = {start: 0}, [self._available(start, unavailable)]
        while stack:
            way = next(stack[-1], None)
            if way is None:
                longest = tuple(word) if len(word) > len(longest) else longest
                stack.pop()
                path.pop()
                del word[-1:]
            elif way[1] in self.live and way[1] not in path and deepest.get(way[1], 0) < len(path):
                deepest[way[1]] = len(path)
                word.append(way[0])
                path.append(way[1])
                stack.append(self._available(way[1], unavailable))
        return longest

    def _probability(self, state: str, word: tuple[str, ...], complete: bool) -> float:
        product = 1.0
        for sub_goal in word:
            target, probability = next((way[1], way[2]) for way in self.ways[state] if way[0] == sub_goal)
            product, state = product * probability, target
        return product * self.finals[state] if complete else product

    def _live(self) -> set[str]:
        live = {state for state, probability in self.finals.items() if probability > 0}
        found = True
        while found:
            new = {source for source, out in self.ways.items() if source not in live and any(w[1] in live for w in out)}
            live |= new
            found = bool(new)
        return live

"""A run on the real server: saved, approved, followed, stored. GOALGRAPH_BIN names the program."""

import asyncio
import json
import os
import subprocess
import urllib.request
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from goalgraph_executor import Executor
from test_transcript import SPECIFICATION, HiddenRed

PROGRAM = os.environ.get("GOALGRAPH_BIN", "")
pytestmark = pytest.mark.skipif(not PROGRAM, reason="GOALGRAPH_BIN names no server")


@pytest.fixture
def address(tmp_path: Path) -> Iterator[str]:
    """A server of our own on a free port of this computer: `127.0.0.1:PORT`."""
    command = [os.path.abspath(PROGRAM), "serve", "--listen", "127.0.0.1:0", "--data", str(tmp_path)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
        try:
            assert server.stdout
            line = next(line for line in server.stdout if "http://" in line)
            yield line.split("http://")[1].split("/")[0]
        finally:
            server.terminate()


def request(method: str, url: str, body: Any = None) -> Any:
    data = None if body is None else json.dumps(body).encode()
    headers = {"content-type": "application/json"}
    with urllib.request.urlopen(urllib.request.Request(url, data, headers, method=method), timeout=20) as answer:
        return json.load(answer)


def approve(api: str, content: str) -> str:
    """Saves a specification and approves it; gives its id."""
    entry = request("POST", f"{api}/specifications", {"content": content, "author": "Ada", "message": "first"})
    revision = entry["head"]
    signature = {"who": "Ada", "meaning": "approved for the test", "sha256": revision["sha256"], "instead_of": None}
    request("POST", f"{api}/specifications/{entry['id']}/revisions/{revision['number']}/approval", signature)
    return str(entry["id"])


def test_a_run_is_followed_around_what_is_unavailable_and_stored(address: str) -> None:
    api = f"http://{address}/api/v1"
    specification = approve(api, SPECIFICATION["content"])
    executor = Executor(f"ws://{address}", "cell 4", HiddenRed(), specification=specification, auto=True)
    asyncio.run(asyncio.wait_for(executor.serve(runs=1), 30))
    [run] = request("GET", f"{api}/runs?specification={specification}")["items"]
    assert (run["phase"], run["trail"], run["replans"]) == ("finished", ["g2", "g1"], 1)
    assert (run["sha256"], run["departure"]) == (SPECIFICATION["sha256"], None)
    events = request("GET", f"{api}/runs/{run['run']}/events")["items"]
    assert [event["number"] for event in events] == list(range(1, 10))
    assert [event["happened"]["event"] for event in events[:4]] == ["planned", "started", "unavailable", "replanned"]

"""A robot that takes a second for every sub-goal. Usage: simulated.py [URL [NAME]]; GOALGRAPH_TOKEN holds the token."""

import asyncio
import logging
import os
import sys

from goalgraph_executor import Executor, SubGoal


class SimulatedRobot:
    async def achieve(self, sub_goal: SubGoal) -> None:
        await asyncio.sleep(1.0)


async def main() -> None:
    url = sys.argv[1] if len(sys.argv) > 1 else "ws://127.0.0.1:7700"
    name = sys.argv[2] if len(sys.argv) > 2 else "python"
    await Executor(url, name, SimulatedRobot(), token=os.environ.get("GOALGRAPH_TOKEN"), auto=True).serve()


if __name__ == "__main__":
    logging.basicConfig(level=logging.INFO, format="%(message)s")
    try:
        asyncio.run(main())
    except KeyboardInterrupt:
        pass

"""Takes turns at learning from the words of a file with AALpy.

Argument: file of words, one a line, symbols separated by blanks. The order `tree` builds the frequency prefix tree, the
first stage of Alergia; any other order runs the whole of Alergia.
"""

import sys
import time

from aalpy.learning_algs import run_Alergia
from aalpy.learning_algs.stochastic_passive.FPTA import create_fpta


def main() -> None:
    with open(sys.argv[1], encoding="utf-8") as lines:
        # A Markov chain emits a symbol in its first state, too.
        words = [["start", *line.split()] for line in lines]
    print("ready", flush=True)
    for order in sys.stdin:
        start = time.perf_counter()
        if order.strip() == "tree":
            create_fpta(words, "mc")
        else:
            run_Alergia(words, automaton_type="mc")
        print(time.perf_counter() - start, flush=True)


main()

"""Takes turns at clustering the points of a file with scikit-learn on one thread.

Arguments: file of little-endian 64-bit numbers, dimension, epsilon, min_points, algorithm, file for the labels. The labels
file holds for each point its label, -1 for noise, and then for each point 1 where it is core, all as 64-bit integers.
"""

import sys
import time

import numpy as np
from sklearn.cluster import DBSCAN


def main() -> None:
    path, dimension, epsilon, min_points, algorithm, labels_path = sys.argv[1:]
    points = np.fromfile(path, dtype="<f8").reshape(-1, int(dimension))
    print("ready", flush=True)
    for _ in sys.stdin:
        clustering = DBSCAN(eps=float(epsilon), min_samples=int(min_points), algorithm=algorithm, n_jobs=1)
        start = time.perf_counter()
        try:
            clustering.fit(points)
        except MemoryError:
            print("out of memory", flush=True)
            return
        seconds = time.perf_counter() - start
        core = np.zeros(len(points), dtype="<i8")
        core[clustering.core_sample_indices_] = 1
        np.concatenate([clustering.labels_.astype("<i8"), core]).tofile(labels_path)
        print(seconds, flush=True)


main()

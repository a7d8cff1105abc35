"""The published method as one writes it with pandas and scikit-learn: CSV files in, words out.

Arguments: epsilon, min_points, then one CSV file for each demonstration. Features that share a name up to the last dot
are one object. Prints one word a line.
"""

import sys

import numpy as np
import pandas as pd
from sklearn.cluster import DBSCAN


def sub_goals(demonstrations, columns, epsilon, min_points):
    """Centers and radii of the clusters of one object, in the order in which they are first reached."""
    states = pd.concat([demonstration[columns] for demonstration in demonstrations]).dropna().to_numpy()
    labels = DBSCAN(eps=epsilon, min_samples=min_points).fit(states).labels_
    starts = [demonstration[columns].dropna().to_numpy()[0] for demonstration in demonstrations]
    found = []
    for label in range(labels.max() + 1):
        cluster = states[labels == label]
        center = cluster.mean(axis=0)
        radius = np.linalg.norm(cluster - center, axis=1).max()
        # One that holds where a demonstration starts is no goal.
        if all(np.linalg.norm(start - center) > radius for start in starts):
            found.append((center, radius))
    return found


def word(demonstration, alphabet):
    """Algorithm 1: in every frame the first sub-goal that is reached and not yet in the word is appended."""
    reached = []
    for columns, center, radius in alphabet:
        states = demonstration[columns].to_numpy()
        # An undefined feature gives NaN, which is not within any radius.
        reached.append(np.linalg.norm(states - center, axis=1) <= radius)
    completed = []
    for frame in range(len(demonstration)):
        for symbol, inside in enumerate(reached):
            if inside[frame] and symbol not in completed:
                completed.append(symbol)
                break
    return completed


def main() -> None:
    epsilon, min_points = float(sys.argv[1]), int(sys.argv[2])
    demonstrations = [pd.read_csv(path) for path in sys.argv[3:]]
    objects = {}
    for column in demonstrations[0].columns:
        objects.setdefault(column.rpartition(".")[0], []).append(column)
    alphabet = []
    for columns in objects.values():
        for center, radius in sub_goals(demonstrations, columns, epsilon, min_points):
            alphabet.append((columns, center, radius))
    for demonstration in demonstrations:
        print(*(f"g{symbol}" for symbol in word(demonstration, alphabet)))


main()

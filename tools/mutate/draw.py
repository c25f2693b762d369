"""Draws places at random: the same for the same seed and sources."""

import random


def quotas(line_counts, count):
    """Distributes `count` places to modules in proportion to their lines of code, by largest remainders."""
    total = max(1, sum(line_counts.values()))
    shares = {module: count * lines / total for module, lines in line_counts.items()}
    given = {module: int(share) for module, share in shares.items()}
    by_remainder = sorted(shares, key=lambda module: (given[module] - shares[module], module))
    for module in by_remainder[:count - sum(given.values())]:
        given[module] += 1
    return given


class Draw:
    """The modules of the changes to try, in order, and each module's places in the order of use."""

    def __init__(self, places, line_counts, count, seed):
        self.slots = [module for module, number in quotas(line_counts, count).items() for _ in range(number)]
        random.Random(f"{seed} order").shuffle(self.slots)
        self.places = {}
        for module, all_of_it in places.items():
            self.places[module] = list(all_of_it)
            random.Random(f"{seed} {module}").shuffle(self.places[module])

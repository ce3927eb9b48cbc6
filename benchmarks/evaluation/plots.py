"""The plots of the evaluation, as SVG files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.figure import Figure

from benchmarks.evaluation.statistics import Summary

# The same bytes for the same figures.
mpl.rcParams["svg.hashsalt"] = "sleec-verify"


def cumulative(path: Path, samples: Mapping[str, Sequence[float]]) -> None:
    """The empirical distribution function of each sample, in milliseconds, up to the largest 95th percentile."""
    figure, axes = _figure("milliseconds from trigger to execution", "share of triggers")
    largest = 0.0
    for name, sample in samples.items():
        ordered = sorted(sample)
        largest = max(largest, ordered[int(0.95 * (len(ordered) - 1))])
        axes.plot(ordered, [(number + 1) / len(ordered) for number in range(len(ordered))], label=name)
    axes.set_xlim(0, largest)
    axes.legend()
    _save(figure, path)


def by_size(path: Path, summaries: Mapping[int, Summary]) -> None:
    """Median, 95th and 99th percentile of the delay, by the number of rules."""
    figure, axes = _figure("rules", "milliseconds from trigger to execution")
    sizes = list(summaries)
    for label, values in (
        ("99 %", [one.p99 for one in summaries.values()]),
        ("95 %", [one.p95 for one in summaries.values()]),
        ("median", [one.median for one in summaries.values()]),
    ):
        axes.plot(sizes, values, marker="o", label=label)
    axes.set_xscale("log")
    axes.set_ylim(bottom=0)
    axes.legend()
    _save(figure, path)


def lines_to_change(path: Path, counts: Mapping[str, Mapping[str, int]]) -> None:
    """The lines of Python for each change, of each variant."""
    figure, axes = _figure("", "lines of Python")
    variants = list(next(iter(counts.values())))
    width = 0.8 / len(variants)
    for number, variant in enumerate(variants):
        positions = [place + number * width for place in range(len(counts))]
        axes.bar(positions, [lines[variant] for lines in counts.values()], width, label=variant)
    axes.set_xticks([place + 0.4 - width / 2 for place in range(len(counts))], list(counts))
    axes.legend()
    _save(figure, path)


def _figure(horizontal: str, vertical: str) -> tuple[Figure, Any]:
    figure = Figure(figsize=(7, 4), layout="constrained")
    axes = figure.subplots()
    axes.set_xlabel(horizontal)
    axes.set_ylabel(vertical)
    return figure, axes


def _save(figure: Figure, path: Path) -> None:
    figure.savefig(path, format="svg", metadata={"Date": None})

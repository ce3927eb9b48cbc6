"""The timeline of a mission as a picture in SVG."""

from sleec_verify.report.mission_plot.plot import plot

__all__ = ["plot"]

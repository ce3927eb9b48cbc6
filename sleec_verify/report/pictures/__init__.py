"""Pictures as SVG: the graph of all rules, the flow of one rule, and timelines.

They need no font, script or file from elsewhere. They have a title and a description for screen readers, and are
readable without colour.
"""

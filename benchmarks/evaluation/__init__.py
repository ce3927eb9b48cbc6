"""The evaluation of the paper (Section 5), repeated: correctness, efficiency, maintainability, and robustness."""

"""Replay: the runtime's evaluators confirm each situation, trace and strategy before anyone sees it."""

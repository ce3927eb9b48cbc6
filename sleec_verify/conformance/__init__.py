"""That the code does what the rules say: by test (docs/conformance.md).

    from sleec_verify.conformance import conformance_test
    test_robot = conformance_test(make_sleec)

Here, and in the pytest plugin, is the one place where `sleec_verify` runs the runtime: as the thing under test.
"""

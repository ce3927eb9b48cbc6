"""``python -m sleec_verify``: the same as the command ``sleec-verify``."""

from sleec_verify.cli import main

if __name__ == "__main__":
    main()

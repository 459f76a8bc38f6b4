"""`python -m agglo` is the program `agglo`."""

from agglo._command import main

if __name__ == "__main__":
    main()

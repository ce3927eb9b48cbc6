"""The answers to the requests of the page, one module for each kind."""

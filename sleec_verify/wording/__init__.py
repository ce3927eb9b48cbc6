"""Words and sentences for people: on the command line, in reports and on the page."""

"""The local page: a run file edited in the browser, computed by processes of this machine, private to its user."""

"""Arrays and FFTs of the libraries with which contacts are solved."""

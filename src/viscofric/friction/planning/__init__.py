"""Which contacts have to be solved for a set of cases: similar cases share a curve."""

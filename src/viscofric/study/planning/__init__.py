"""What has to be solved for a set of cases: families of similar ones, and curves that each family lies on."""

"""`ion suite`: many drives, judged by their verdicts."""

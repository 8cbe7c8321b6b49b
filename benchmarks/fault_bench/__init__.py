"""The fault matrix: what is put into recordings, how the answer is judged, and the tables of both."""

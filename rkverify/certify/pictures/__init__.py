"""What Figures 1 to 3 of the paper draw by hand, computed: a cell, two kinds of support, motion relative to a kernel's centre."""

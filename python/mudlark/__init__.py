"""Reading and drawing the results of Mudlark, and the reference solutions that they are compared with."""

struct Status { 1: double angle }

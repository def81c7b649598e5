struct Limits { 1: double min = -1.5; 2: double max = 1.5 }
typedef double Speed

struct Point { 1: double x, 2: double y }
typedef i32 Port

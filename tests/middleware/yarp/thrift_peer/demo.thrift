/** Types and calls of every kind, for the peer that code of yarpidl_thrift is. */
namespace yarp demo

enum Color { RED, GREEN = 5, BLUE }

struct Point {
  1: double x;
  2: double y;
  3: string label;
}

struct Path {
  1: list<Point> points;
  2: map<string, i32> tags;
  3: bool closed;
  4: set<i16> ids;
  5: Color color;
  6: Point start;
}

service Demo {
  i32 add(1: i32 a, 2: i32 b);
  bool set_flag(1: bool on);
  oneway void go_home_now(1: i32 where_to);
  i32 place();
  Path make_path(1: Point start, 2: list<double> xs);
  i32 measure_path(1: Path path);
  void reset();
  string get_long_method_name(1: string what = "x");
  i64 next_number(1: i64 value);
  double twice(1: double value);
  i8 negated(1: i8 value);
  i16 half(1: i16 value);
  binary reversed(1: binary data);
  list<string> names();
  map<string, Point> table();
  Color paint(1: Color color);
  list<Color> colors(1: list<Color> values);
}

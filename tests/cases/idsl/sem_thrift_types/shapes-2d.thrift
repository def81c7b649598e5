// Every form of declaration.
namespace yarp yarp.test (some.annotation = "x")
namespace * other
cpp_include "<vector>"
include "first/point.thrift"

typedef point.Point Corner
typedef point.Port Port
typedef list<Corner> (cpp.template = "std::vector") Corners
const double PI = 3.14, const string NAME = 'it\'s'
const bool ON = true;
enum Color { RED, GREEN = 5; BLUE } (final)
struct Style { 1: Color color = Color.GREEN; 2: bool filled = 1 } ( yarp.editor = "true" )
struct Shape {
  1: required Corners corners,
  -2: optional Style style = {};
  map<string, map<i32, list<binary>>> data
  4: set<Color> colors (yarp.type = "std::vector<Color>")
  5: byte small = -128
  6: i8 tiny; 7: i16 medium = 0x7f; 8: i64 large = 9007199254740993
  9: double ratio = PI
  10: string name = NAME
  11: Vector v
}
struct Vector { } (yarp.name = "yarp::sig::Vector"; yarp.includefile = "yarp/sig/Vector.h")
struct Real { } (yarp.name="yarp::conf::float64_t")
exception Failed { 1: string reason }
service Base { list<Corner> corners() (yarp.qualifier = "const") }
service Draw extends Base {
  Real area(1: Shape shape) throws (1: Failed failed),
  oneway void clear();
  void move(1: Real x = 1.5, 2: Color color = RED, 3: list<double> path = [])
}

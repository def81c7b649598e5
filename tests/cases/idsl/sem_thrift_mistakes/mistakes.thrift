include "other.idsl"
include "missing.thrift"
namespace yarp
struct Whole {
  1: i32 first;
  1: i32 again;
  2: i32
  3: lisst<i32> items;
  4: list<i32 numbers;
  5: Unknown unknown;
  6: missing.Point elsewhere;
  7: i16 small = 70000;
  8: bool flag = "yes";
  9: Color color = Color.GREEN;
  10: map<double, i32> by_number;
  11: i32 again
}
enum Color { RED = 1, BLUE = 1.5, RED = 3 }
union Either { 1: i32 number, 2: string text }
senum Word { "a", "b" }
service Calls {
  oneway i32 ask();
  bool go(1: i32)
  bool stop()
  bool stop();
  void fail() throws (1: Whole whole);
}
service More extends Calls { bool stop(); }
service Most extends Whole { }
const i32 HALF = 0.5;
const list<i32> ALL = [1, [2]];
typedef i32
struct Optional { 1: optional i32 number; 2: optional i32 one = 1 }
struct Foreign { } (yarp.name = "yarp::os::Property")
enum Mode { } (yarp.name = "yarp::dev::Mode")
@
struct Last { 1: i32 x

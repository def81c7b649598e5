// A server and a client of `demo.thrift`, over code that yarpidl_thrift generates.

#include <demo/Demo.h>

#include <yarp/os/Network.h>
#include <yarp/os/Port.h>
#include <yarp/os/RpcClient.h>
#include <yarp/os/RpcServer.h>
#include <yarp/os/Time.h>

#include <algorithm>
#include <iostream>

using namespace demo;

class DemoServer : public Demo
{
public:
    std::int32_t add(std::int32_t a, std::int32_t b) override { return a + b; }
    bool set_flag(bool on) override { return on; }
    void go_home_now(std::int32_t where_to) override { m_place = where_to; }
    std::int32_t place() override { return m_place; }
    Path make_path(const Point& start, const std::vector<double>& xs) override
    {
        Path path;
        for (double x : xs) {
            path.points.emplace_back(x, 2 * x, "p");
        }
        path.tags = {{"a", 1}, {"b", 2}};
        path.closed = true;
        path.ids = {3, 4};
        path.color = BLUE;
        path.start = start;
        return path;
    }
    std::int32_t measure_path(const Path& path) override
    {
        return static_cast<std::int32_t>(1000 * path.points.size() + 100 * path.tags.at("a")
                                         + 10 * path.ids.size() + (path.closed ? 5 : 0)
                                         + path.start.x);
    }
    void reset() override { m_place = 0; }
    std::string get_long_method_name(const std::string& what) override { return what + "!"; }
    std::int64_t next_number(std::int64_t value) override { return value + 1; }
    double twice(double value) override { return 2 * value; }
    std::int8_t negated(std::int8_t value) override { return static_cast<std::int8_t>(-value); }
    std::int16_t half(std::int16_t value) override { return static_cast<std::int16_t>(value / 2); }
    std::string reversed(const std::string& data) override
    {
        return {data.rbegin(), data.rend()};
    }
    std::vector<std::string> names() override { return {"a", "b"}; }
    std::map<std::string, Point> table() override { return {{"k", Point(1, 2, "z")}}; }
    Color paint(Color color) override { return color; }
    std::vector<Color> colors(const std::vector<Color>& values) override
    {
        return values;
    }

private:
    std::int32_t m_place{0};
};

static int serve(const std::string& name)
{
    DemoServer server;
    yarp::os::RpcServer port;
    server.yarp().attachAsServer(port);
    port.open(name);
    while (true) {
        yarp::os::Time::delay(1);
    }
}

static int call(const std::string& name)
{
    Demo demo;
    yarp::os::RpcClient port;
    port.open("/democlient");
    demo.yarp().attachAsClient(port);
    if (!yarp::os::Network::connect("/democlient", name)) {
        return 2;
    }
    demo.reset();
    demo.go_home_now(7);
    const Path path = demo.make_path(Point(1, 2, "s"), {1.5, 2.5});
    std::cout << demo.add(1, 2) << ' ' << demo.set_flag(true) << demo.set_flag(false) << ' '
              << demo.get_long_method_name("hey") << ' ' << demo.next_number(1LL << 40) << ' '
              << demo.twice(0.25) << ' ' << int(demo.negated(-3)) << ' ' << demo.half(-300) << ' '
              << demo.reversed("xyz") << ' ' << demo.names().at(1) << ' '
              << demo.table().at("k").label << ' ' << demo.paint(GREEN) << ' '
              << demo.colors({RED, BLUE}).at(1) << ' ' << demo.measure_path(path) << std::endl;
    std::cout << path.toString() << std::endl;
    return 0;
}

static int publish(const std::string& name, const std::string& target)
{
    yarp::os::Port port;
    port.open(name);
    DemoServer server;
    if (!yarp::os::Network::connect(name, target)) {
        return 2;
    }
    port.write(server.make_path(Point(1, 2, "s"), {1.5, 2.5}));
    port.close();
    return 0;
}

int main(int argc, char** argv)
{
    yarp::os::Network network;
    const std::string mode = argc > 2 ? argv[1] : "";
    if (mode == "serve") {
        return serve(argv[2]);
    }
    if (mode == "publish") {
        return publish(argv[2], argv[3]);
    }
    return mode == "call" ? call(argv[2]) : 64;
}

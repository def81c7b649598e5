// A C++ component as RoboComp's generator wrote them: Ice::Application, etc/config, uncheckedCast.
// It serves Laser, and drives a DifferentialRobot.
#include <Ice/Ice.h>

#include <chrono>
#include <iostream>
#include <thread>

#include "GenericBase.cpp"
#include "DifferentialRobot.cpp"
#include "Laser.cpp"

class LaserI : public RoboCompLaser::Laser
{
public:
    RoboCompLaser::TLaserData getLaserData(const Ice::Current &) override
    {
        RoboCompLaser::TLaserData scan(3);
        for (int i = 0; i < 3; i++)
        {
            scan[i].angle = 0.5f * (i - 1);
            scan[i].dist = 1000.f + i;
        }
        return scan;
    }
    RoboCompLaser::TLaserData getLaserAndBStateData(RoboCompGenericBase::TBaseState &state,
                                                    const Ice::Current &current) override
    {
        state = RoboCompGenericBase::TBaseState();
        state.x = 12.5f;
        return getLaserData(current);
    }
    RoboCompLaser::LaserConfData getLaserConfData(const Ice::Current &) override
    {
        RoboCompLaser::LaserConfData configuration = RoboCompLaser::LaserConfData();
        configuration.driver = "hokuyo";
        return configuration;
    }
};

class LaserComp : public Ice::Application
{
public:
    int run(int, char *[]) override
    {
        shutdownOnInterrupt();
        auto properties = communicator()->getProperties();
        auto base = RoboCompDifferentialRobot::DifferentialRobotPrx::uncheckedCast(
            communicator()->stringToProxy(properties->getProperty("DifferentialRobotProxy")));
        auto adapter = communicator()->createObjectAdapter("Laser");
        adapter->add(new LaserI, Ice::stringToIdentity("laser"));
        adapter->activate();
        std::cout << "LaserComp started" << std::endl;
        while (!communicator()->isShutdown())
        {
            try
            {
                drive(base);
            }
            catch (const Ice::Exception &error)
            {
                std::cout << "no base: " << error.ice_id() << std::endl;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
        return 0;
    }

private:
    void drive(const RoboCompDifferentialRobot::DifferentialRobotPrx &base)
    {
        base->setSpeedBase(150.f, 0.25f);
        RoboCompGenericBase::TBaseState state;
        base->getBaseState(state);
        int x, z;
        float alpha;
        base->getBasePose(x, z, alpha);
        std::cout << "base drives at " << state.advVz << " from " << x << " " << z << std::endl;
        try
        {
            base->setSpeedBase(-1.f, 0.f);
        }
        catch (const RoboCompGenericBase::HardwareFailedException &error)
        {
            std::cout << "base failed: " << error.what << std::endl;
        }
    }
};

int main(int argc, char *argv[])
{
    LaserComp app;
    return app.main(argc, argv);
}

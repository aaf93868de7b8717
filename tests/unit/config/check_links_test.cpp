// Links: each is one that there can be, of the right wire and speed, and a device hangs on it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/checks.h"
#include "unit/config/config_text.h"

namespace drover::config {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(ConfigurationChecks, RefuseALinkThatDoesNotExist) {
  EXPECT_EQ(
      problems(with("\"link\": \"can0\", \"options\": {\"node\": 2}",
                    "\"link\": \"cna0\", \"options\": {\"node\": 2}")),
      "f:6:43: devices.right.link: there is no link named \"cna0\" (did you mean \"can0\"?)\n");
}

TEST(ConfigurationChecks, RefuseMoreLinksOnWhichSomethingMovesThanTheGuardHasRoomFor) {
  const auto with_arms = [](int count) {
    std::string links = R"("base": {"serial": "/dev/drover/base", "baud": 115200})";
    std::string devices = R"("base": {"driver": "gt01_serial", "link": "base"})";
    for (int i = 0; i < count; ++i) {
      const auto number = std::to_string(i);
      links += R"(, "can)" + number + R"(": {"can": "can)" + number + R"("})";
      devices += R"(, "j)" + number + R"(": {"driver": "damiao", "link": "can)" + number +
                 R"(", "options": {"id": 1, "model": "DM4310"}})";
    }
    return problems("{\"links\": {" + links + "}, \"devices\": {" + devices + "}}");
  };
  EXPECT_THAT(with_arms(8),
              HasSubstr("links.can7: is one link too many on which something moves: drover-guard "
                        "stops 8"));
  EXPECT_THAT(with_arms(7), Not(HasSubstr("drover-guard stops")));
}

TEST(ConfigurationChecks, RefuseASpeedThatNoLineHas) {
  EXPECT_THAT(problems(with("115200", "115201")),
              HasSubstr("links.gnss.baud: is 115201, but a line has one of 4800, 9600"));
}

TEST(ConfigurationChecks, RefuseALineThatIsNoWholePath) {
  const auto serial = [](const std::string& port) {
    return problems(with("\"/dev/drover/gnss\"", "\"" + port + "\""));
  };
  EXPECT_EQ(serial("ttyUSB0"),
            "f:3:32: links.gnss.serial: \"ttyUSB0\" is no absolute path: it would be looked for in "
            "droverd's working folder (did you mean \"/dev/ttyUSB0\"?)\n");
  EXPECT_THAT(serial("dev/drover/gnss"), HasSubstr("(did you mean \"/dev/drover/gnss\"?)"));
  EXPECT_THAT(serial("./gnss"), HasSubstr("(a path like \"/dev/ttyUSB0\")"));
  auto text = with("\"panel\"", "\"bms\": {\"modbus\": \"ttyS1\"}, \"panel\"");
  EXPECT_THAT(problems(text), HasSubstr("links.bms.modbus: \"ttyS1\" is no absolute path"));
}

TEST(ConfigurationChecks, RefuseAnInterfaceThatTheKernelCannotName) {
  EXPECT_THAT(
      problems(with("{\"can\": \"can0\"}", "{\"can\": \"can0_of_the_left_side\"}")),
      HasSubstr("links.can0.can: \"can0_of_the_left_side\" is no name of an interface: they "
                "have up to 15 characters"));
  EXPECT_THAT(problems(with("{\"can\": \"can0\"}", "{\"can\": \"/dev/can0\"}")),
              HasSubstr("links.can0.can: \"/dev/can0\" is no name of an interface: they have no "
                        "slash (did you mean \"can0\"?)"));
  EXPECT_THAT(problems(with("{\"can\": \"can0\"}", "{\"can\": \"/dev/ttyUSB0\"}")),
              HasSubstr("they have no slash (slcand makes one of a serial adapter: its name, like "
                        "\"slcan0\")"));
  EXPECT_EQ(problems(with("{\"can\": \"can0\"}", "{\"can\": \"unix:/tmp/can0\"}")), "");
}

TEST(ConfigurationChecks, RefuseAnInterfaceWithASpace) {
  EXPECT_THAT(problems(with("{\"can\": \"can0\"}", "{\"can\": \"CAN 1\"}")),
              testing::HasSubstr("links.can0.can: \"CAN 1\" is no name of an interface: they have "
                                 "neither spaces nor colons"));
}

TEST(ConfigurationChecks, RefuseALinkOfTheWrongWire) {
  EXPECT_EQ(
      problems(with("\"link\": \"can0\", \"options\": {\"node\": 2}",
                    "\"link\": \"gnss\", \"options\": {\"node\": 2}")),
      "f:6:43: devices.right.link: \"gnss\" is a serial line, but odrive hangs on a CAN bus\n");
  EXPECT_EQ(
      problems(with("\"nmea0183\", \"link\": \"gnss\"", "\"nmea0183\", \"link\": \"can0\"")),
      "f:7:44: devices.gnss.link: \"can0\" is a CAN bus, but nmea0183 hangs on a serial line\n");
}

TEST(ConfigurationChecks, RefuseALinkOfNoKindOrOfTwo) {
  EXPECT_EQ(problems(with("{\"can\": \"can0\"}", "{}")),
            "f:2:21: links.can0: has none of: can, serial, modbus, gpio\n");
  EXPECT_EQ(problems(with("{\"can\": \"can0\"}", "{\"can\": \"can0\", \"gpio\": \"b\"}")),
            "f:2:45: links.can0.gpio: is given beside can (one of: can, serial, modbus, gpio)\n");
}

TEST(ConfigurationChecks, RefuseALinkThatNoDeviceHangsOn) {
  EXPECT_EQ(
      problems(with("{\"can\": \"can0\"}", "{\"can\": \"can0\"}, \"b\": {\"can\": \"can1\"}")),
      "f:2:43: links.b: no device hangs on it (leave it out)\n");
  // One that the outputs' chip hangs on is used.
  auto text = with("\"gpio\": \"chip0\"}", "\"gpio\": \"chip0\"}, \"b\": {\"gpio\": \"chip1\"}");
  const std::string_view outputs = "\"outputs\": {\"link\": \"panel\"";
  text.replace(text.find(outputs), outputs.size(), "\"outputs\": {\"link\": \"b\"");
  EXPECT_EQ(problems(text), "");
}

TEST(ConfigurationChecks, RefuseASpeedWhereALinkHasNone) {
  EXPECT_EQ(problems(with("{\"can\": \"can0\"}", "{\"can\": \"can0\", \"baud\": 1000000}"))
                .find("must be between"),
            std::string::npos);
  EXPECT_EQ(problems(with("{\"can\": \"can0\"}", "{\"can\": \"can0\", \"baud\": 500000}")),
            "f:2:45: links.can0.baud: is of no use on a CAN bus (leave it out: BitRate= in "
            "/etc/systemd/network/80-can0.network is this one's)\n");
  EXPECT_EQ(problems(with("115200", "115200, \"parity\": \"even\"")),
            "f:3:78: links.gnss.parity: is of no use on a serial line (leave it out)\n");
}

TEST(ConfigurationChecks, RefuseASecondDeviceOnASerialLine) {
  const auto text = with("\"gnss\": {\"driver\": \"nmea0183\", \"link\": \"gnss\"},",
                         "\"gnss\": {\"driver\": \"nmea0183\", \"link\": \"gnss\"},\n"
                         "\"rear\": {\"driver\": \"nmea0183\", \"link\": \"gnss\"},");
  EXPECT_THAT(problems(text), HasSubstr("devices.rear.link: \"gnss\" is a serial line, and "
                                        "devices.gnss hangs on it\n"));
}

TEST(ConfigurationChecks, RefuseTwoLinksOnOnePort) {
  EXPECT_THAT(
      problems(with("\"panel\"", "\"imu\": {\"serial\": \"/dev//drover/gnss\"}, \"panel\"")),
      HasSubstr("links.imu.serial: \"/dev//drover/gnss\" is used by links.gnss.serial already"));
}

TEST(ConfigurationChecks, PointAtTheSpeedOfALineThatIsTooSlowForItsSensor) {
  const auto imu = [](const std::string& baud) {
    auto text = with("\"panel\"",
                     R"("imu": {"serial": "/dev/drover/imu", "baud": )" + baud + "}, \"panel\"");
    return problems(text.insert(text.find("    \"estop\""),
                                R"("imu": {"driver": "witmotion", "link": "imu"},)"));
  };
  EXPECT_EQ(imu("115200"), "");
  EXPECT_EQ(imu("9600"),
            "f:3:114: links.imu.baud: is 9600, but rate_Hz 100 needs 38400 or more: droverd sets "
            "the sensor to the speed that stands here; or a rate_Hz of 20 and less\n");
  // What is wrong by itself is told alone.
  EXPECT_THAT(imu("9601"), AllOf(StartsWith("f:3:114: links.imu.baud: is 9601, but a line has"),
                                 testing::Not(HasSubstr("devices.imu"))));
  EXPECT_EQ(imu("\"9600\""),
            "f:3:114: links.imu.baud: is a text, but a whole number is expected (write it without "
            "quotes)\n");
}

TEST(ConfigurationChecks, TellOfALineThatIsTooSlowForItsReceiversPositions) {
  const auto told = [](const std::string& baud, const std::string& options) {
    auto text = with("115200", baud);
    const std::string_view link = "\"nmea0183\", \"link\": \"gnss\"";
    return warnings(text.insert(text.find(link) + link.size(), options));
  };
  EXPECT_THAT(
      told("4800", ""),
      HasSubstr("f:3:60: links.gnss.baud: is 4800, which carries 480 bytes a second, and "
                "devices.gnss.options.rate_Hz is 10: its positions alone take 700 (a faster "
                "line, or fewer positions a second: at the receiver and here)\n"));
  const auto slow = HasSubstr("positions alone");
  EXPECT_THAT(told("4800", R"(, "options": {"rate_Hz": 5})"), Not(slow));
  EXPECT_THAT(told("115200", ""), Not(slow));
  EXPECT_THAT(told("9600", R"(, "options": {"rate_Hz": 20})"), slow);
}

}  // namespace
}  // namespace drover::config

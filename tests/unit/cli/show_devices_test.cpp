#include "cli/show_devices.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/rates.h"
#include "unit/cli/parsed.h"

namespace drover::cli {
namespace {

const DeviceView& view(std::string_view name) {
  for (const auto& each : device_views())
    if (each.name == name) return each;
  ADD_FAILURE() << "no view " << name;
  return device_views().front();
}

std::string shown(std::string_view name, std::string_view status) {
  return view(name).show(parsed(status));
}

TEST(DeviceViews, TellWhatIsNotConfigured) {
  const auto none = parsed(R"({"gnss":null,"links":[{"name":"gnss"}],"axes":[],"lines":{}})");
  EXPECT_EQ(missing(view("gnss"), none),
            "not configured: there is no receiver in droverd's configuration");
  EXPECT_EQ(missing(view("can"), none),
            "not configured: there is no drive in droverd's configuration");
  EXPECT_EQ(missing(view("gpio"), none),
            "not configured: there is no digital input or output in droverd's configuration");
  EXPECT_EQ(missing(view("imu"), none), "this droverd does not tell of imu: it is older");
  EXPECT_EQ(missing(view("imu"), parsed(R"({"imu":{"age_s":null}})")), "");
}

TEST(DeviceViews, ShowAbsentValuesAsADashAndNeverAsZero) {
  for (const auto& each : device_views()) {
    const auto text = each.show(parsed(
        R"({"gnss":{},"imu":{"acceleration_mps2":[null,null,null]},"battery":{"soc_percent":null},
            "links":[{"name":"can0","bus":true,"up":true}],"axes":[{"joint":"left"}],
            "lines":{"estop":{"active":false}}})"));
    EXPECT_EQ(text.find('0'), text.find("can0") == std::string::npos ? std::string::npos : 3)
        << text;
    EXPECT_NE(text.find('-'), std::string::npos) << text;
  }
}

TEST(DeviceViews, ShowTheReceiver) {
  EXPECT_EQ(shown("gnss", R"({"gnss":{"health":"fresh","quality":"rtk fixed",
      "latitude_deg":42.8333333333,"longitude_deg":-76.5,"altitude_msl_m":100,"sigma_east_m":0.01,
      "sigma_north_m":0.012,"speed_mps":0.5,"course_deg":null,
      "receiver_heading_deg":180.25,"heading_deg":90.25,"heading_age_s":0.14,"satellites":20,
      "hdop":0.7,"correction_age_s":0.8,"age_s":0.08,"samples":120,"bad":3,"rate_Hz":10,
      "reason":"odd"}})"),
            "quality   rtk fixed  satellites 20  hdop 0.70  corrections 0.8 s old\n"
            "position  latitude 42.833333333 deg  longitude -76.500000000 deg  altitude 100.000 m\n"
            "sigma     east 0.010 m  north 0.012 m\n"
            "motion    speed 0.500 m/s  course -\n"
            "heading   as received 180.25 deg (0.1 s old)  "
            "robot's, less the mounting 90.25 deg\n"
            "rate      10.0 Hz  age 0.080 s  samples 120  bad 3\n"
            "health    fresh\n"
            "          odd\n");
}

TEST(DeviceViews, ShowTheInertialSensor) {
  EXPECT_EQ(shown("imu", R"({"imu":{"health":"fresh","acceleration_mps2":[0.1,-0.2,9.81],
      "angular_velocity_radps":[0,0,0.5],"gyro_bias_radps":[null,null,null],
      "gyro_bias_sigma_radps":null,"roll_rad":0.01,"pitch_rad":-0.02,"temperature_degC":31,
      "saturated":true,"age_s":0.004,"samples":900,"bad":0,"rate_Hz":100,"reason":""}})"),
            "accel     x    0.100  y   -0.200  z    9.810  m/s2\n"
            "gyro      x   0.0000  y   0.0000  z   0.5000  rad/s\n"
            "bias      x -  y -  z -  rad/s  sigma z -\n"
            "attitude  roll 0.0100 rad  pitch -0.0200 rad\n"
            "chip      temperature 31.0 C  SATURATED\n"
            "rate      100.0 Hz  age 0.004 s  samples 900  bad 0\n"
            "health    fresh\n");
}

TEST(DeviceViews, ShowTheBattery) {
  EXPECT_EQ(shown("bms", R"({"battery":{"health":"fresh","soc_percent":86.4,"voltage_V":53,
      "current_A":-8.9,"remaining_Ah":null,"temperature_degC":23,"mosfet_degC":null,
      "min_cell_V":3.31,"max_cell_V":3.34,"flow":"discharging","charger_connected":true,
      "alarm":"cell voltage low","age_s":0.5,"samples":7,"bad":0,"rate_Hz":null,"reason":""}})"),
            "charge    86.4 %  remaining -  discharging  CHARGER CONNECTED\n"
            "pack      53.00 V  -8.90 A into it\n"
            "cells     lowest 3.310 V  highest 3.340 V\n"
            "warmth    cells 23.0 C  switch -\n"
            "alarm     cell voltage low\n"
            "rate      -  age 0.500 s  samples 7  bad 0\n"
            "health    fresh\n");
}

TEST(DeviceViews, ShowAllOfAKindWhereThereAreSeveral) {
  const std::string sensors =
      R"("sensors":[
      {"kind":"imu","name":"imu","role":"steers","in_use":true,"health":"fresh"},
      {"kind":"battery","name":"left","role":"steers","in_use":true,"health":"fresh",
       "soc_percent":84,"voltage_V":26.4,"current_A":-2,"age_s":0.5,"reason":""},
      {"kind":"battery","name":"right","role":"spare","in_use":false,"health":"never heard",
       "soc_percent":null,"age_s":null,"reason":"no answer"}])";
  EXPECT_THAT(
      shown("bms", R"({"battery":{"health":"fresh"},)" + sensors + "}"),
      testing::HasSubstr("battery   left            steers IN USE  84.0 %  26.40 V  "
                         "-2.0 A  fresh  0.50 s old\n"
                         "          right           spare          never heard  no answer\n"));
  EXPECT_THAT(shown("imu", R"({"imu":{"health":"fresh"},)" + sensors + "}"),
              testing::Not(testing::HasSubstr("steers")));
}

TEST(DeviceViews, ShowBusesAndDrivesButNoOtherLinks) {
  EXPECT_EQ(
      shown("can", R"({"links":[{"name":"can0","bus":true,"up":false,"reason":"no such device",
          "received":10,"sent":5,"dropped":0,"refused":1,"received_Hz":2.5,"sent_Hz":null,
          "dropped_Hz":0,"refused_Hz":0},{"name":"gnss","bus":false,"up":true}],
          "axes":[{"joint":"left","state":"fault","position_rad":1,"velocity_radps":-2,
          "effort_Nm":3,"motor_degC":40,"inverter_degC":null,"bus_V":48,"bus_A":1.5,"rate_Hz":100,
          "age_s":0.01,"bad":0,"health":"stale","fault":"spinout","reason":"silent"}]})"),
      "can0          DOWN  received 10 (2.5/s)  sent 5 (-)  dropped 0 (0.0/s)  refused 1 (0.0/s)  "
      "no such device\n"
      "left          fault         1.000 rad   -2.000 rad/s    3.00 Nm  motor 40 C  inverter -  "
      "bus 48.0 V 1.5 A\n"
      "              100.0 Hz  age 0.010 s  bad 0  stale  spinout  silent\n");
}

TEST(DeviceViews, ShowLinesInWordsAndOutputs) {
  EXPECT_EQ(shown("gpio", R"({"lines":{
          "estop":{"active":true,"health":"stale","samples":2,"reason":"the line cannot be read"},
          "zone_near":{"active":false,"health":"fresh","samples":4,"reason":""}},
          "outputs":{"lamp":true,"buzzer":false}})"),
            "estop     ACTIVE  pressed: no motion  stale       changes 2  the line cannot be read\n"
            "zone_near clear   free                fresh       changes 4\n"
            "lamp      on\n"
            "buzzer    off\n");
}

TEST(Rates, AreUnknownWhenNothingNewCameOrCountersWentBack) {
  auto now = parsed(R"({"time_s":11,"gnss":{"samples":5,"age_s":1.1},
      "links":[{"name":"can0","received":4}]})");
  add_rates(now, parsed(R"({"time_s":10,"gnss":{"samples":5,"age_s":0.1},
      "links":[{"name":"can0","received":100}]})"));
  EXPECT_TRUE(now.find("gnss")->find("rate_Hz")->is_null());
  EXPECT_TRUE((*now.find("links")->list())[0].find("received_Hz")->is_null());
}

TEST(Rates, ComeFromTheInstantsOfTheSamples) {
  // Ten samples in 1.0 s of the samples' own time, though the answers are 1.03 s apart.
  auto now = parsed(R"({"time_s":11.03,"imu":{"samples":30,"age_s":0.04},
      "links":[{"name":"can0","received":300,"sent":7}]})");
  add_rates(now, parsed(R"({"time_s":10,"imu":{"samples":20,"age_s":0.01},
      "links":[{"name":"can1","received":1},{"name":"can0","received":94,"sent":7}]})"));
  EXPECT_NEAR(*now.find("imu")->find("rate_Hz")->number(), 10, 1e-9);
  const auto& link = (*now.find("links")->list())[0];
  EXPECT_NEAR(*link.find("received_Hz")->number(), 200, 1e-9);
  EXPECT_EQ(link.find("sent_Hz")->number(), 0);
}

TEST(Rates, AnObjectIsWrittenAsItWasRead) {
  const std::string text = R"({"a":[1,2.5,null,true],"b":{"c":"d\u000a"},"e":-3})";
  EXPECT_EQ(json_line(parsed(text)), text);
}

}  // namespace
}  // namespace drover::cli

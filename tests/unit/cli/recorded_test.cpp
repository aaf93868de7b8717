#include "cli/recorded.h"

#include <gtest/gtest.h>

#include <sstream>
#include <vector>

#include "cli/option_texts.h"

namespace drover::cli {
namespace {

struct Shown {
  int code = -1;
  std::string out;
  std::string notes;
};

Shown show(std::string_view device, const std::string& recorded, const Recording& recording) {
  std::istringstream in(recorded);
  std::ostringstream out;
  std::ostringstream notes;
  Shown shown;
  shown.code = show_recording(device, in, recording, out, notes);
  shown.out = out.str();
  shown.notes = notes.str();
  return shown;
}

std::string usage_error(std::string_view device, const Recording& recording) {
  try {
    show(device, "", recording);
  } catch (const WrongUsage& wrong) {
    return wrong.what();
  }
  return "none";
}

const std::string kMap = std::string(DROVER_SOURCE_DIR) + "/config/maps/jk_pb.json";
const std::string kFrames =
    "(1718000000.000000) can0 061#0000000008000100\n"
    "(1718000000.010000) can0 069#00004841000050C0\n"
    "(1718000000.020000) can1 069#00004841000050C0\n"
    "(1718000000.020000) can0 069#000048\n"
    "no frame\n"
    "(1718000000.110000) can0 061#0000000101030000\n";

TEST(Recordings, RefuseWhatNoDriverCanRead) {
  EXPECT_EQ(usage_error("gpio", {}), "levels of GPIO lines are not recorded: leave out --file");
  EXPECT_EQ(usage_error("gnss", {.driver = "odrive"}),
            "no driver \"odrive\" for this device: nmea0183");
  EXPECT_EQ(usage_error("gnss", {.driver = "NMEA"}),
            "no driver \"NMEA\" for this device: nmea0183 (did you mean \"nmea0183\"?)");
  EXPECT_EQ(usage_error("bms", {.driver = "modbus_bms"}),
            "--map is missing: the file of the registers");
  EXPECT_EQ(usage_error("can", {.driver = "odrive"}), "the driver needs --option node=VALUE");
  EXPECT_EQ(usage_error("can", {.driver = "cia402"}),
            "the driver needs --option node=VALUE --option velocity_units_per_rps=VALUE "
            "--option gear_ratio=VALUE --option acceleration=VALUE --option deceleration=VALUE");
  EXPECT_EQ(usage_error("can", {.nodes = {3}}), "--node and --option need --driver");
}

TEST(Recordings, RefuseOptionsThatTheDriverWouldNotTake) {
  const auto error = [](const std::string& option) {
    return usage_error("can", {.driver = "odrive", .options = {option}});
  };
  EXPECT_EQ(error("nodes=3"), "the driver has no option \"nodes\"");
  EXPECT_EQ(error("node"), "option node: no =VALUE");
  EXPECT_EQ(error("node=x"), "option node: \"x\" is no number");
  EXPECT_EQ(error("node=1.5"), "option node: \"1.5\" is no whole number");
  EXPECT_EQ(error("node=63"), "option node: \"63\" is out of range");
  EXPECT_EQ(error("reversed=1"), "option reversed: \"1\" is neither true nor false");
  EXPECT_EQ(error("firmware=0.7"), "option firmware: \"0.7\" is none of its choices");
}

TEST(Recordings, WithoutAnythingUnderstoodAreAFailure) {
  const auto shown = show("gnss", "noise\r\n$GNGGA,bad*00\r\n", {.driver = "nmea0183"});
  EXPECT_EQ(shown.code, 1);
  EXPECT_EQ(shown.out, "");
  EXPECT_EQ(shown.notes, "measurements 0, malformed 1\n");
}

TEST(Recordings, OfAReceiverAreDecoded) {
  const auto shown = show("gnss",
                          "$GNGGA,123519.00,4250.000000,N,07630.000000,W,4,20,0.7,100.000,M,"
                          "-30.000,M,0.8,0001*64\r\n$GNGGA,1*00\r\n",
                          {.driver = "nmea0183"});
  EXPECT_EQ(shown.code, 0);
  EXPECT_EQ(shown.out,
            "      87  gnss_position  quality rtk fixed  latitude 42.833333333 deg  "
            "longitude -76.500000000 deg  altitude msl 100.000 m  satellites 20  hdop 0.70  "
            "correction age 0.8 s  sigma east -  sigma north -\n");
  EXPECT_EQ(shown.notes, "measurements 1, malformed 1\n");
}

TEST(Recordings, OfAnInertialSensorAreDecoded) {
  const unsigned char bytes[] = {0x55, 0x51, 0, 0,    0,    0,    0,    8,    0xf6, 0x09, 0xad,
                                 0x55, 0x52, 0, 0,    0,    0,    0xa4, 0,    0xf6, 0x09, 0x4a,
                                 0x55, 0x53, 0, 0x20, 0xab, 0xea, 0,    0x40, 0xf4, 0x01, 0x92};
  const auto shown =
      show("imu", std::string(std::begin(bytes), std::end(bytes)), {.driver = "witmotion"});
  EXPECT_EQ(shown.code, 0);
  EXPECT_EQ(shown.out,
            "      33  imu_sample  acceleration 0.000 0.000 9.807 m/s2  "
            "angular velocity 0.0000 0.0000 0.1747 rad/s  roll 0.7854 rad  pitch -0.5236 rad  "
            "yaw 1.5708 rad  temperature 25.5 C  saturated no\n");
}

TEST(Recordings, OfABusAreDecodedForTheNodesThatWereNamed) {
  const auto shown =
      show("can", kFrames, {.driver = "odrive", .nodes = {3, 4}, .bus = "can0", .json = true});
  EXPECT_EQ(shown.code, 0);
  EXPECT_EQ(
      shown.out,
      R"({"ok":true,"t_s":1.718e+09,"device":"node 3","kind":"axis_status","state":"running",)"
      R"("error_code":"0x0","fault":""})"
      "\n"
      R"({"ok":true,"t_s":1718000000.01,"device":"node 3","kind":"axis_motion",)"
      R"("position_rad":78.53981633974483,"velocity_radps":-20.420352248333657,)"
      R"("effort_Nm":null})"
      "\n"
      R"({"ok":true,"t_s":1718000000.11,"device":"node 3","kind":"axis_status","state":"idle",)"
      R"("error_code":"0x1000000","fault":"its watchdog ran out while nobody fed it: )"
      R"(cleared at the next start"})"
      "\n");
  EXPECT_NE(shown.notes.find("line 5: not of the form (SECONDS) BUS ID#DATA\n"), std::string::npos);
  EXPECT_NE(shown.notes.find("measurements 3, malformed 1, lines not understood 1\n"),
            std::string::npos)
      << shown.notes;
}

TEST(Recordings, OfABusWithoutADriverAreCounted) {
  const auto shown = show("can", kFrames, {});
  EXPECT_EQ(shown.code, 0);
  EXPECT_EQ(shown.out,
            "bus       id          frames          rate  bytes  last\n"
            "can0      061              2        9.1 Hz      8  0000000101030000\n"
            "can0      069              2      100.0 Hz      3  000048\n"
            "can1      069              1             -      8  00004841000050C0\n");
  EXPECT_EQ(shown.notes,
            "line 5: not of the form (SECONDS) BUS ID#DATA\nframes 5, lines not understood 1\n");
}

TEST(Recordings, TellAProgramInEachObjectThatItIsWell) {
  const auto shown = show("can", kFrames, {.json = true});
  std::istringstream lines(shown.out);
  int rows = 0;
  for (std::string line; std::getline(lines, line); ++rows)
    EXPECT_EQ(line.find(R"({"ok":true,"bus":)"), 0U) << line;
  EXPECT_EQ(rows, 3);
}

TEST(Recordings, OfABatteryAreDecodedAsFarAsTheyGoAndTellWhatIsMissing) {
  const auto shown = show("bms",
                          "# voltage only\n"
                          "01 03 12 90 00 02 C1 5E\n"
                          "01 03 04 00 00 CC 79 6E D1\n"
                          "01 03 04 00 00 CC 79 6E D2\n",
                          {.driver = "modbus_bms", .map = kMap});
  EXPECT_EQ(shown.code, 0);
  EXPECT_NE(shown.out.find("voltage 52.34 V  current -"), std::string::npos) << shown.out;
  EXPECT_NE(shown.notes.find("line 4: wrong checksum\n"), std::string::npos) << shown.notes;
  EXPECT_NE(shown.notes.find("not in the recording: "), std::string::npos) << shown.notes;
  EXPECT_NE(shown.notes.find("current (0x1298)"), std::string::npos) << shown.notes;
  EXPECT_EQ(shown.notes.find("voltage"), std::string::npos) << shown.notes;
}

TEST(Recordings, OfABatteryMakeASampleOfEachRoundEvenWhenRoundsHoldLess) {
  const auto shown = show("bms",
                          "0x1290: 0000 CC79\n0x1298: FFFF E0C0\n"
                          "0x1290: 0000 CC7A\n"
                          "0x1290: 0000 CC7B\n0x1298: FFFF E0C1\n",
                          {.driver = "modbus_bms", .map = kMap});
  EXPECT_EQ(shown.notes.find("voltage"), std::string::npos) << shown.notes;
  std::istringstream lines(shown.out);
  std::vector<std::string> rounds;
  for (std::string line; std::getline(lines, line);) rounds.push_back(line);
  ASSERT_EQ(rounds.size(), 3U) << shown.out;
  EXPECT_EQ(rounds[0].find("       2  battery"), 0U) << rounds[0];
  EXPECT_NE(rounds[0].find("current -8.00 A"), std::string::npos) << rounds[0];
  EXPECT_NE(rounds[1].find("current -  "), std::string::npos) << rounds[1];  // not the old one
  EXPECT_NE(rounds[2].find("current -8.00 A"), std::string::npos) << rounds[2];
}

TEST(Recordings, OfABatteryMayBeWrittenAsLoggersWriteBytes) {
  const Recording daly{.driver = "modbus_bms",
                       .map = std::string(DROVER_SOURCE_DIR) + "/config/maps/daly_d2.json"};
  for (const std::string text : {
           "D2 03 00 28 00 03 96 60\nD2 03 06 02 12 74 D7 03 60 BA B1\n",
           "d203002800039660\nd20306 021274 d703 60ba b1\n",
           ">>> D2.03.00.28.00.03.96.60 (8)\n<<< D2.03.06.02.12.74.D7.03.60.BA.B1 (11)\n",
           "[12:00:01][D][uart_debug:114]: >>> D2:03:00:28:00:03:96:60\n"
           "[12:00:01][D][uart_debug:114]: <<< D2:03:06:02:12:74:D7:03:60:BA:B1\n",
           "0xD2, 0x03, 0x00, 0x28, 0x00, 0x03, 0x96, 0x60\n"
           "{0xD2, 0x3, 0x6, 0x02, 0x12, 0x74, 0xD7, 0x3, 0x60, 0xBA, 0xB1},\n",
           "0x0028: 0x0212, 0x74D7, 0x0360\n",
       }) {
    const auto shown = show("bms", text, daly);
    EXPECT_NE(shown.out.find("soc 86.4 %  voltage 53.00 V  current -8.90 A"), std::string::npos)
        << text << shown.notes;
  }
}

TEST(Recordings, OfABatteryHaveAddressesInDecimalOrHexadecimalAsTheirManualHas) {
  const Recording daly{.driver = "modbus_bms",
                       .map = std::string(DROVER_SOURCE_DIR) + "/config/maps/daly_d2.json"};
  for (const std::string head : {"0x28", "0x0028", "40", "3/40", "3/0x28", " 40 "}) {
    const auto shown = show("bms", head + ": 0212 74D7 0360\n", daly);
    EXPECT_NE(shown.out.find("voltage 53.00 V  current -8.90 A"), std::string::npos)
        << head << shown.notes;
  }
  // Which of the two is meant must not be guessed.
  for (const std::string head : {"0028", "A0", "28h", "0x"}) {
    const auto shown = show("bms", head + ": 0212 74D7 0360\n", daly);
    EXPECT_NE(shown.notes.find("line 1: \"" + head +
                               "\" is no address: 40 is decimal, 0x28 is hexadecimal\n"),
              std::string::npos)
        << head << shown.notes;
  }
  const auto beyond = show("bms", "65536: 0212\n", daly);
  EXPECT_NE(beyond.notes.find("line 1: \"65536\" is no address"), std::string::npos)
      << beyond.notes;
}

TEST(Recordings, OfABatterySayThatAnotherUnitAnswersThanTheMapsOne) {
  const auto shown = show("bms",
                          ">>> 81.03.00.28.00.03.9A.03\n"
                          "<<< 51.03.06.02.12.74.D7.03.60.CF.87\n",
                          {.driver = "modbus_bms",
                           .map = std::string(DROVER_SOURCE_DIR) + "/config/maps/daly_d2.json"});
  EXPECT_NE(shown.notes.find("line 2: unit 0x51 answers; the map's is 0xD2\n"), std::string::npos)
      << shown.notes;
}

TEST(Recordings, OfABatteryAreDecodedWhicheverBlocksTheMasterRead) {
  std::string text;
  // 62 registers from 0, as words and in two pieces: 14.0 V, 3 A, 90 %.
  text += "0x0000: 101F 1029 1033 103D";
  for (int i = 0; i < 28; ++i) text += " 0000";
  text += " 003C 003D 003E 003F 0000 0000 0000 0000\n0x28: 008C 754E 0384 103D 101F 0000 0000 ";
  text += "0000 0D80 0004 0004 0039 0001 0000 0001 102E 0141 002A 0000 0000 0000 0000\n";
  text += "5/0: 1\n0x3E: 12345\n0x3E: \x1b[2J\n";
  const auto shown = show("bms", text,
                          {.driver = "modbus_bms",
                           .map = std::string(DROVER_SOURCE_DIR) + "/config/maps/daly_d2.json"});
  EXPECT_EQ(shown.out,
            "       2  battery  soc 90.0 %  voltage 14.00 V  current 3.00 A  "
            "remaining 345.6 Ah  temperature 23.0 C  mosfet -  min cell 4.127 V  "
            "max cell 4.157 V  flow idle  charger connected no  charges yes  alarm -\n")
      << shown.notes;
  EXPECT_EQ(shown.notes,
            "line 3: the function is neither 3 nor 4\nline 4: \"12345\" is no word\n"
            "line 5: \"?[2J\" is no word\nmeasurements 1, lines not understood 3\n");
}

}  // namespace
}  // namespace drover::cli

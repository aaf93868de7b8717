#include "gateway/recording/input_codec.h"

#include <gtest/gtest.h>

#include "gateway/recording/text.h"
#include "tests/unit/gateway/one_of_each_input.h"

namespace drover::gateway {
namespace {

const Wiring kNamed;
constexpr Time kBefore{std::chrono::seconds(7)};

TEST(InputCodec, GivesBackEachInputAsItWas) {
  OneOfEachInput all;
  for (const auto& input : all.inputs) {
    std::array<std::uint8_t, 2048> buffer{};
    ByteWriter out(buffer);
    write_input(input, kBefore, out);
    ASSERT_TRUE(out.good());
    ByteReader in(out.written());
    const auto find = [&all](std::uint64_t number) {
      return number == all.path.number ? &all.path : nullptr;
    };
    const Input read = read_input(kind_of(input), kBefore, find, in);
    EXPECT_TRUE(in.done()) << text_of(input, kNamed);
    EXPECT_EQ(read.time, input.time);
    EXPECT_EQ(text_of(read, kNamed), text_of(input, kNamed));
    std::array<std::uint8_t, 2048> again{};
    ByteWriter rewritten(again);
    write_input(read, kBefore, rewritten);
    EXPECT_EQ(buffer, again) << text_of(input, kNamed);
  }
}

/// It permits nothing, and a replay must not take it for one of the first instant.
TEST(InputCodec, GivesBackAClearanceOfNoTimeAsOne) {
  Clearance unknown;
  unknown.unknown = "nothing was looked at yet";
  unknown.broken = "the fence of field_north";
  for (const Time t : {kNever, Time{}, kBefore}) {
    unknown.t = t;
    std::array<std::uint8_t, 512> buffer{};
    ByteWriter out(buffer);
    write_input({kBefore, ClearanceFound{unknown}}, kBefore, out);
    ASSERT_TRUE(out.good());
    ByteReader in(out.written());
    const Input read = read_input(
        kind_of({kBefore, ClearanceFound{}}), kBefore, [](auto) { return nullptr; }, in);
    ASSERT_TRUE(in.done());
    const auto& found = std::get<ClearanceFound>(read.body).clearance;
    EXPECT_EQ(found.t, t);
    EXPECT_EQ(found.broken, unknown.broken);
    EXPECT_EQ(found.unknown, unknown.unknown);
  }
}

TEST(InputCodec, RefusesEachInputThatIsCutShort) {
  OneOfEachInput all;
  for (const auto& input : all.inputs) {
    std::array<std::uint8_t, 2048> buffer{};
    ByteWriter out(buffer);
    write_input(input, kBefore, out);
    for (std::size_t size = 0; size < out.written().size(); ++size) {
      ByteReader in(out.written().first(size));
      (void)read_input(
          kind_of(input), kBefore, [&](auto) { return &all.path; }, in);
      EXPECT_FALSE(in.good()) << text_of(input, kNamed) << " of " << size << " bytes";
    }
  }
}

TEST(InputCodec, TellsWhatDoesNotFitIntoTheBuffer) {
  std::array<std::uint8_t, 8> buffer{};
  ByteWriter out(buffer);
  write_input({kBefore, LinkLost{0, "can0: lost (No such device)"}}, kBefore, out);
  EXPECT_FALSE(out.good());
}

}  // namespace
}  // namespace drover::gateway

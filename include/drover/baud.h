// The speeds at which lines can be opened, bits a second.
#pragma once

#include <array>

namespace drover {

inline constexpr std::array kSerialBauds{4800,   9600,   19200,  38400, 57600,
                                         115200, 230400, 460800, 921600};
/// libmodbus takes any other for 9600 without a word.
inline constexpr std::array kModbusBauds{1200,  2400,   4800,   9600,   19200, 38400,
                                         57600, 115200, 230400, 460800, 921600};

}  // namespace drover

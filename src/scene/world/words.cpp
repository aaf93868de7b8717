#include "scene/world/words.h"

#include <cmath>

#include "drover/fixed_text.h"
#include "text/control.h"
#include "text/utf8.h"

namespace drover::scene::words {

std::string number(double value, int decimals) {
  const double step = std::pow(10.0, -decimals);
  FixedText<64> text;
  text.format("%.*f", decimals, std::abs(value) < step / 2 ? 0.0 : value);
  return std::string(text.view());
}

std::string quoted(std::string_view name) {
  const std::string_view shown = text::beginning(name, 64);
  std::string out = "\"" + text::harmless(shown);
  out += shown.size() < name.size() ? "...\"" : "\"";
  return out;
}

}  // namespace drover::scene::words

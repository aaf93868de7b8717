#include "scene/world/words.h"

#include <cmath>

#include "drover/fixed_text.h"
#include "text/control.h"

namespace drover::scene::words {

std::string number(double value, int decimals) {
  const double step = std::pow(10.0, -decimals);
  FixedText<64> text;
  text.format("%.*f", decimals, std::abs(value) < step / 2 ? 0.0 : value);
  return std::string(text.view());
}

std::string quoted(std::string_view name) {
  FixedText<64> shown(name);
  std::string out = "\"" + text::harmless(shown.view());
  out += shown.view().size() < name.size() ? "...\"" : "\"";
  return out;
}

}  // namespace drover::scene::words

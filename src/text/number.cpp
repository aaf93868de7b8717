#include "text/number.h"

#include <cstdio>

namespace drover::text {

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

}  // namespace drover::text

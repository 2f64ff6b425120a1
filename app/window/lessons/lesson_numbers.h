// Numbers with their units in the sentences of a lesson. Thread: any.
#pragma once

#include <string>

#include "app/window/words/words.h"

namespace trocar {

/// Two decimals at most, no zeros at the end.
std::string brief(const Words& words, double value);
std::string newtons(const Words& words, double n);
/// "0.4 to 0.8 N".
std::string newtons_between(const Words& words, double low, double high);
std::string millimetres(const Words& words, double m);
std::string degrees(const Words& words, double rad);

}  // namespace trocar

// Numbers with their units in sentences. Pure. Thread: any.
#pragma once

#include <string>

#include "app/window/words/translator.h"

namespace trocar {

/// Two decimals at most, no zeros at the end.
std::string brief(const Translator& words, double value);
std::string newtons(const Translator& words, double n);
/// "0.4 to 0.8 N".
std::string newtons_between(const Translator& words, double low, double high);
std::string millimetres(const Translator& words, double m);
std::string degrees(const Translator& words, double rad);

}  // namespace trocar

// Reads the value of a console variable from text, clamps it, and shows it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

struct FParsedCVar
{
	std::optional<FRTCVarValue> Value; ///< absent: Error says why
	std::string Error;
	int ClampedTo = 0; ///< -1: raised to the minimum, +1: lowered to the maximum
};

/// Parses Text as the type that Like holds, times Factor if that is a number, clamped to Range.
FParsedCVar ParseCVar(const FRTCVarValue& Like, FRTCVarRange Range, std::string_view Text, double Factor = 1.0);

/// Parses a finite decimal number that is the whole text. Fails if it is too large for a double.
std::optional<double> ParseNumber(std::string_view Text);

const char* GetTypeName(const FRTCVarValue& Value);
bool IsNumber(const FRTCVarValue& Value);
bool HasMin(FRTCVarRange Range);
bool HasMax(FRTCVarRange Range);
/// Returns "1 to 64", "at least 0" or "at most 1"; empty if unlimited or not a number.
std::string DescribeRange(const FRTCVarValue& Like, FRTCVarRange Range);
bool IsInRange(const FRTCVarValue& Value, FRTCVarRange Range);

} // namespace Lantern

// Values of console variables: parsing, clamping and printing.
#include "Config/ConsoleVariableValues.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "Text/TextTools.h"

namespace Lantern
{
std::optional<double> ParseNumber(std::string_view Text)
{
	if (Text.size() > 1 && Text[0] == '+' && Text[1] != '-') Text.remove_prefix(1);
	double Number = 0.0;
	const auto [End, Error] = std::from_chars(Text.data(), Text.data() + Text.size(), Number);
	if (Error != std::errc() || End != Text.data() + Text.size() || !std::isfinite(Number)) return std::nullopt;
	return Number;
}

namespace
{

/// The words that UE accepts in ini files.
std::optional<bool> ParseBoolWord(std::string_view Text)
{
	for (const char* Word : {"true", "yes", "on"})
		if (EqualsIgnoringCase(Text, Word)) return true;
	for (const char* Word : {"false", "no", "off"})
		if (EqualsIgnoringCase(Text, Word)) return false;
	return std::nullopt;
}

double Clamp(double Number, double Min, double Max, int& OutClampedTo)
{
	if (Number < Min)
	{
		OutClampedTo = -1;
		return Min;
	}
	if (Number > Max)
	{
		OutClampedTo = 1;
		return Max;
	}
	return Number;
}

FParsedCVar ParseBool(std::string_view Text)
{
	if (Text == "0" || Text == "1") return {.Value = Text == "1"};
	if (const std::optional<bool> Word = ParseBoolWord(Text)) return {.Value = *Word};
	return {.Error = "is not a bool (0, 1, false or true)"};
}

FParsedCVar ParseInt(FRTCVarRange Range, std::string_view Text, double Factor)
{
	if (const std::optional<bool> Word = ParseBoolWord(Text)) return ParseInt(Range, *Word ? "1" : "0", Factor);
	const std::optional<double> Number = ParseNumber(Text);
	// What another unit makes of a number need not be whole.
	if (!Number || (Factor == 1.0 && *Number != std::trunc(*Number))) return {.Error = "is not a whole number"};
	using FLimits = std::numeric_limits<int32_t>;
	FParsedCVar Result;
	const double Clamped = Clamp(std::round(*Number * Factor), std::max<double>(std::ceil(Range.Min), FLimits::min()),
	    std::min<double>(std::floor(Range.Max), FLimits::max()), Result.ClampedTo);
	Result.Value = static_cast<int32_t>(Clamped);
	return Result;
}

FParsedCVar ParseFloat(FRTCVarRange Range, std::string_view Text, double Factor)
{
	const std::optional<double> Number = ParseNumber(Text);
	if (!Number) return {.Error = "is not a number"};
	constexpr double Largest = std::numeric_limits<float>::max();
	FParsedCVar Result;
	const double Clamped = Clamp(*Number * Factor, std::max(Range.Min, -Largest), std::min(Range.Max, Largest), Result.ClampedTo);
	Result.Value = static_cast<float>(Clamped);
	return Result;
}

double ToNumber(const FRTCVarValue& Value)
{
	if (const auto* Int = std::get_if<int32_t>(&Value)) return *Int;
	if (const auto* Float = std::get_if<float>(&Value)) return *Float;
	return 0.0;
}

/// Bounds beyond this count as absent; it is the default of FRTCVarRange.
constexpr double NoBound = 1e30;

} // namespace

FParsedCVar ParseCVar(const FRTCVarValue& Like, FRTCVarRange Range, std::string_view Text, double Factor)
{
	if (std::holds_alternative<std::string>(Like)) return {.Value = std::string(Text)};
	Text = Trim(Text);
	if (std::holds_alternative<bool>(Like)) return ParseBool(Text);
	return std::holds_alternative<int32_t>(Like) ? ParseInt(Range, Text, Factor) : ParseFloat(Range, Text, Factor);
}

const char* GetTypeName(const FRTCVarValue& Value)
{
	constexpr const char* Names[] = {"bool", "int", "float", "string"};
	static_assert(std::variant_size_v<FRTCVarValue> == std::size(Names));
	return Names[Value.index()];
}

bool IsNumber(const FRTCVarValue& Value) { return std::holds_alternative<int32_t>(Value) || std::holds_alternative<float>(Value); }

bool HasMin(FRTCVarRange Range) { return Range.Min > -NoBound; }

bool HasMax(FRTCVarRange Range) { return Range.Max < NoBound; }

std::string DescribeRange(const FRTCVarValue& Like, FRTCVarRange Range)
{
	if (!IsNumber(Like)) return {};
	if (HasMin(Range) && HasMax(Range)) return fmt::format("{:g} to {:g}", Range.Min, Range.Max);
	if (HasMin(Range)) return fmt::format("at least {:g}", Range.Min);
	return HasMax(Range) ? fmt::format("at most {:g}", Range.Max) : std::string();
}

bool IsInRange(const FRTCVarValue& Value, FRTCVarRange Range)
{
	return !IsNumber(Value) || (ToNumber(Value) >= Range.Min && ToNumber(Value) <= Range.Max);
}

} // namespace Lantern

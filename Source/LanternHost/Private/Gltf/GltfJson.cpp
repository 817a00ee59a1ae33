// Typed access to JSON values, with their place in every error.
#include "Gltf/GltfJson.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "LanternCore/Text/Quote.h"

namespace Lantern::Gltf
{

void FJson::AppendPath(std::string& Out) const
{
	if (Parent != nullptr)
	{
		Parent->AppendPath(Out);
		if (Key == nullptr) { Out += fmt::format("[{}]", Index); }
		else { Out += Out.empty() ? Key : fmt::format(".{}", Key); }
	}
}

std::string FJson::GetPath() const
{
	std::string Path;
	AppendPath(Path);
	return Path;
}

void FJson::Fail(std::string_view Message) const
{
	const std::string Path = GetPath();
	throw FError(Path.empty() ? std::string(Message) : fmt::format("{}: {}", Path, Message));
}

void FJson::RequireObject() const
{
	if (!Value->is_object()) { Fail(fmt::format("expected an object, found {}", Value->type_name())); }
}

FJson FJson::Member(const char* MemberKey) const&
{
	if (Value == nullptr) { return FJson(nullptr, this, MemberKey, 0); }
	RequireObject();
	const auto Found = Value->find(MemberKey);
	return FJson(Found == Value->end() ? nullptr : &*Found, this, MemberKey, 0);
}

FJson FJson::Extension(const char* Name) const&
{
	if (Value == nullptr) { return {}; }
	RequireObject();
	const auto Extensions = Value->find("extensions");
	if (Extensions == Value->end()) { return {}; }
	if (!Extensions->is_object()) { Fail("'extensions' is not an object"); }
	const auto Found = Extensions->find(Name);
	// Named without the "extensions" in between, which would need a parent that lives on.
	return Found == Extensions->end() ? FJson() : FJson(&*Found, this, Name, 0);
}

FJson FJson::Extra(const char* Name) const&
{
	if (Value == nullptr || !Value->is_object()) { return {}; }
	const auto Extras = Value->find("extras");
	if (Extras == Value->end() || !Extras->is_object()) { return {}; }
	const auto Found = Extras->find(Name);
	return Found == Extras->end() ? FJson() : FJson(&*Found, this, Name, 0); // named without "extras", as extensions are
}

size_t FJson::Count() const
{
	if (Value == nullptr) { return 0; }
	if (!Value->is_array()) { Fail(fmt::format("expected an array, found {}", Value->type_name())); }
	return Value->size();
}

FJson FJson::Element(size_t ElementIndex) const& { return FJson(&(*Value)[ElementIndex], this, nullptr, ElementIndex); }

std::string FJson::Dump() const { return Value != nullptr ? Value->dump() : std::string(); }

uint64_t FJson::ToUInt(uint64_t Max) const
{
	uint64_t Result = 0;
	if (Value->is_number_unsigned()) { Result = Value->get<uint64_t>(); }
	else if (Value->is_number_float() && Value->get<double>() >= 0 && Value->get<double>() < 0x1p53 &&
	         std::floor(Value->get<double>()) == Value->get<double>())
	{
		Result = uint64_t(Value->get<double>()); // "3.0", as some writers have it
	}
	else { Fail(fmt::format("expected a non-negative integer, found {}", Value->is_number() ? Value->dump() : Value->type_name())); }
	if (Result > Max) { Fail(fmt::format("{} is more than {}", Result, Max)); }
	return Result;
}

double FJson::ToNumber() const
{
	if (!Value->is_number()) { Fail(fmt::format("expected a number, found {}", Value->type_name())); }
	const double Number = Value->get<double>();
	if (!std::isfinite(Number)) { Fail("not a finite number"); }
	return Number;
}

float FJson::ToFloat() const
{
	const double Number = ToNumber();
	if (std::abs(Number) > double(std::numeric_limits<float>::max())) { Fail(fmt::format("{} is beyond what a float holds", Number)); }
	return float(Number);
}

const std::string& FJson::ToString() const
{
	if (!Value->is_string()) { Fail(fmt::format("expected a string, found {}", Value->type_name())); }
	return Value->get_ref<const std::string&>();
}

uint64_t FJson::GetUInt(const char* MemberKey, uint64_t Default, uint64_t Max) const
{
	const FJson Found = Member(MemberKey);
	return Found.Exists() ? Found.ToUInt(Max) : Default;
}

int32_t FJson::GetIndex(const char* MemberKey, size_t Size, const char* What) const
{
	const FJson Found = Member(MemberKey);
	if (!Found.Exists()) { return -1; }
	const uint64_t FoundIndex = Found.ToUInt(UINT64_MAX);
	if (FoundIndex >= Size || FoundIndex > uint64_t(INT32_MAX))
	{
		Found.Fail(fmt::format("there is no {} {} (there are {})", What, FoundIndex, Size));
	}
	return int32_t(FoundIndex);
}

int32_t FJson::RequireIndex(const char* MemberKey, size_t Size, const char* What) const
{
	const int32_t Found = GetIndex(MemberKey, Size, What);
	if (Found < 0) { Fail(fmt::format("'{}' is missing", MemberKey)); }
	return Found;
}

float FJson::GetFloat(const char* MemberKey, float Default) const
{
	const FJson Found = Member(MemberKey);
	return Found.Exists() ? Found.ToFloat() : Default;
}

bool FJson::GetBool(const char* MemberKey, bool Default) const
{
	const FJson Found = Member(MemberKey);
	if (!Found.Exists()) { return Default; }
	if (!Found.Value->is_boolean()) { Found.Fail(fmt::format("expected true or false, found {}", Found.Value->type_name())); }
	return Found.Value->get<bool>();
}

std::string FJson::GetString(const char* MemberKey, const char* Default) const
{
	const FJson Found = Member(MemberKey);
	return Found.Exists() ? Found.ToString() : Default;
}

bool FJson::GetNumbers(const char* MemberKey, size_t Size, double* Out) const
{
	const FJson Found = Member(MemberKey);
	if (!Found.Exists()) { return false; }
	if (Found.Count() != Size) { Found.Fail(fmt::format("expected {} numbers, found {}", Size, Found.Count())); }
	for (size_t I = 0; I < Size; ++I)
	{
		// As floats: what a float cannot hold would become infinite further on.
		Out[I] = double(Found.Element(I).ToFloat());
	}
	return true;
}

glm::vec2 FJson::GetVec2(const char* MemberKey, const glm::vec2& Default) const
{
	double V[2];
	return GetNumbers(MemberKey, 2, V) ? glm::vec2(V[0], V[1]) : Default;
}

glm::vec3 FJson::GetVec3(const char* MemberKey, const glm::vec3& Default) const
{
	double V[3];
	return GetNumbers(MemberKey, 3, V) ? glm::vec3(V[0], V[1], V[2]) : Default;
}

glm::vec4 FJson::GetVec4(const char* MemberKey, const glm::vec4& Default) const
{
	double V[4];
	return GetNumbers(MemberKey, 4, V) ? glm::vec4(V[0], V[1], V[2], V[3]) : Default;
}

namespace
{

// Recursion over a document, here or in a library, is safe below this; glTF itself nests about 8 deep, and "extras"
// a little more.
constexpr int MaxNesting = 200;

void CheckNesting(std::string_view Text)
{
	int Depth = 0;
	bool bInString = false;
	for (size_t I = 0; I < Text.size(); ++I)
	{
		const char C = Text[I];
		if (bInString)
		{
			I += C == '\\' ? 1 : 0;
			bInString = C != '"';
		}
		else if (C == '"') { bInString = true; }
		else if (C == '{' || C == '[')
		{
			if (++Depth > MaxNesting) { throw FError(fmt::format("byte {}: JSON nested deeper than {} levels", I, MaxNesting)); }
		}
		else if (C == '}' || C == ']') { --Depth; }
	}
}

} // namespace

nlohmann::json ParseJson(std::string_view Text)
{
	CheckNesting(Text);
	try
	{
		return nlohmann::json::parse(Text.begin(), Text.end());
	}
	catch (const nlohmann::json::exception& Exception)
	{
		// "[json.exception.parse_error.101] parse error at line 1, column 2: …": the bracket says nothing to a user.
		// The last word read follows, as it is in the file and of any length.
		constexpr size_t MaxReason = 300;
		const std::string_view What = Exception.what();
		const size_t End = What.find("] ");
		const std::string_view Reason = End == std::string_view::npos ? What : What.substr(End + 2);
		throw FError("not valid JSON: " + EscapeText(Reason, MaxReason));
	}
}

} // namespace Lantern::Gltf

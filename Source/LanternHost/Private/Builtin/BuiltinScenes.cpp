#include "LanternHost/BuiltinScenes.h"

#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "Builtin/Courtyard.h"
#include "Builtin/TestScenes.h"

namespace Lantern
{

namespace
{

struct FParameter
{
	const char* Name;
	float Default, Min, Max;
};

/// One row per scene: what it is called, what it takes, and how it is built.
struct FEntry
{
	FBuiltinSceneInfo Info;
	std::vector<FParameter> Parameters;
	FSceneDescription (*Build)(const float* P);
};

const std::vector<FEntry>& GetEntries()
{
	using namespace Builtin;
	static const std::vector<FEntry> Entries = {
	    {{"courtyard", "", "an arcaded courtyard at evening: fountain, trees, ivy, lanterns, a turning weather vane"},
	     {},
	     [](const float*) { return BuildCourtyard(); }},
	    {{"furnace", "ALBEDO=0.5", "closed room that emits 0.5; every pixel is 0.5/(1-albedo)"},
	     {{"ALBEDO", 0.5f, 0.0f, 0.99f}},
	     [](const float* P) { return BuildFurnace(P[0]); }},
	    {{"sphere", "ALBEDO=0.5",
	      "inside of a diffuse sphere of 96 m^2 around 10,000 lm; irradiance 104.17/(1-albedo)"},
	     {{"ALBEDO", 0.5f, 0.0f, 0.99f}},
	     [](const float* P) { return BuildSphere(P[0]); }},
	    {{"polygonlight", "X=0", "unit square light 1 m above a floor of albedo 0.5, seen at the point X"},
	     {{"X", 0.0f, -10.0f, 10.0f}},
	     [](const float* P) { return BuildPolygonLight(P[0]); }},
	    {{"formfactors", "PERPENDICULAR=0", "two unit squares; the mean of a square picture is half their form factor"},
	     {{"PERPENDICULAR", 0.0f, 0.0f, 1.0f}},
	     [](const float* P) { return BuildFormFactors(P[0] >= 0.5f); }},
	    {{"disk", "HEIGHT=1", "disk light of radius 1 m above a floor of albedo 0.5, seen on its axis"},
	     {{"HEIGHT", 1.0f, 0.1f, 10.0f}},
	     [](const float* P) { return BuildDisk(P[0]); }},
	    {{"spherelight", "DISTANCE=2:ANGLE=0", "sphere light of radius 0.5 m over a floor of albedo 0.5"},
	     {{"DISTANCE", 2.0f, 1.0f, 100.0f}, {"ANGLE", 0.0f, 0.0f, 75.0f}},
	     [](const float* P) { return BuildSphereLight(P[0], P[1]); }},
	    {{"ggx", "ROUGHNESS=0.5:MU=0.7",
	      "metal of F = 1 under a sky of 1; every pixel is the lobe's albedo at cosine MU"},
	     {{"ROUGHNESS", 0.5f, 0.0f, 1.0f}, {"MU", 0.7f, 0.02f, 1.0f}},
	     [](const float* P) { return BuildGgx(P[0], P[1]); }},
	    {{"penumbra", "HEIGHT=1", "straight edge over a floor, seen straight down; 4 penumbra widths high"},
	     {{"HEIGHT", 1.0f, 0.01f, 100.0f}},
	     [](const float* P) { return BuildPenumbra(P[0]); }},
	    {{"planes", "", "single-sided planes facing up and down, and a double-sided one, between sun and floor"},
	     {},
	     [](const float*) { return BuildPlanes(); }},
	    {{"emptysky", "", "nothing but sky"}, {}, [](const float*) { return BuildEmptySky(); }},
	};
	return Entries;
}

const FEntry* FindEntry(std::string_view NameWithParameters)
{
	const std::string_view Name = NameWithParameters.substr(0, NameWithParameters.find(':'));
	for (const FEntry& Entry : GetEntries())
	{
		if (Name == Entry.Info.Name)
		{
			return &Entry;
		}
	}
	return nullptr;
}

/// Fills OutValues, or returns what is wrong.
std::string ParseParameters(const FEntry& Entry, std::string_view Text, std::array<float, 4>& OutValues)
{
	for (size_t I = 0; I < Entry.Parameters.size(); ++I)
	{
		OutValues[I] = Entry.Parameters[I].Default;
	}
	for (size_t I = 0; !Text.empty(); ++I)
	{
		Text.remove_prefix(1); // the colon
		const std::string_view Word = Text.substr(0, Text.find(':'));
		Text.remove_prefix(Word.size());
		if (I >= Entry.Parameters.size())
		{
			return fmt::format("'{}' is one parameter too many", Word);
		}
		const FParameter& Parameter = Entry.Parameters[I];
		float Value = 0.0f;
		const auto [End, Error] = std::from_chars(Word.data(), Word.data() + Word.size(), Value);
		if (Error != std::errc() || End != Word.data() + Word.size() || !(Value >= Parameter.Min) ||
		    !(Value <= Parameter.Max))
		{
			return fmt::format("{} is '{}', expected a number from {} to {}", Parameter.Name, Word, Parameter.Min,
			                   Parameter.Max);
		}
		OutValues[I] = Value;
	}
	return {};
}

} // namespace

std::span<const FBuiltinSceneInfo> GetBuiltinScenes()
{
	static const std::vector<FBuiltinSceneInfo> Infos = []
	{
		std::vector<FBuiltinSceneInfo> Result;
		for (const FEntry& Entry : GetEntries())
		{
			Result.push_back(Entry.Info);
		}
		return Result;
	}();
	return Infos;
}

std::string GetBuiltinSceneNames()
{
	std::string Names;
	for (const FBuiltinSceneInfo& Info : GetBuiltinScenes())
	{
		Names += (Names.empty() ? "" : ", ") + std::string(Info.Name);
	}
	return Names;
}

bool IsBuiltinScene(std::string_view NameWithParameters)
{
	return FindEntry(NameWithParameters) != nullptr;
}

FLoadResult BuildBuiltinScene(const std::string& NameWithParameters)
{
	const FEntry* Entry = FindEntry(NameWithParameters);
	if (Entry == nullptr)
	{
		return {std::nullopt,
		        fmt::format("{}: no such built-in scene; there are {}", NameWithParameters, GetBuiltinSceneNames())};
	}
	const size_t Colon = NameWithParameters.find(':');
	const std::string_view Text =
	    Colon == std::string::npos ? std::string_view() : std::string_view(NameWithParameters).substr(Colon);
	std::array<float, 4> Values{};
	const std::string Error = ParseParameters(*Entry, Text, Values);
	if (!Error.empty())
	{
		return {std::nullopt, fmt::format("{}: {}", NameWithParameters, Error)};
	}
	FLoadResult Result;
	Result.Scene = Entry->Build(Values.data());
	Result.Scene->Name = NameWithParameters;
	return Result;
}

} // namespace Lantern

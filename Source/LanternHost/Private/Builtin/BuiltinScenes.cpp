// The table of built-in scenes, and how their names and parameters are read.
#include "LanternHost/BuiltinScenes.h"

#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "Builtin/Courtyard/Courtyard.h"
#include "Builtin/GlassScene.h"
#include "Builtin/Lamps.h"
#include "Builtin/LeavesScene.h"
#include "Builtin/Stability/StabilityScenes.h"
#include "Builtin/Tests/TestScenes.h"
#include "Builtin/ToonScene.h"
#include "Builtin/WaterScene.h"
#include "LanternCore/Text/Quote.h"

namespace Lantern
{

namespace
{

using namespace Builtin;

struct FParameter
{
	const char* Name = nullptr; ///< null: there is none
	float Default = 0.0f, Min = 0.0f, Max = 0.0f;
};

constexpr size_t MostParameters = 2;
using FValues = std::array<float, MostParameters>;

/// One row per scene: its name, its parameters, and the function that builds it.
struct FEntry
{
	FBuiltinSceneInfo Info;
	FParameter Parameters[MostParameters];
	FSceneDescription (*Build)(const FValues& P);
};

constexpr FEntry Entries[] = {
    {{"courtyard", "", "an arcaded courtyard at evening: fountain, trees, ivy, lanterns, a turning weather vane"}, {},
        [](const FValues&) { return BuildCourtyard(); }},
    {{"lamps", "COUNT=640", "a building of 225 rooms with the COUNT lamps nearest to the one in the picture"},
        {{"COUNT", 640.0f, 0.0f, 10000.0f}}, [](const FValues& P) { return BuildLamps(uint32_t(P[0])); }},
    {{"toon", "STYLED=1", "two figures of a stylised look in a lane between painted walls; 0: without their styles"},
        {{"STYLED", 1.0f, 0.0f, 1.0f}}, [](const FValues& P) { return BuildToonScene(P[0] >= 0.5f); }},
    {{"glass", "", "a room with a window, and what light shines through: solid, thin, tinted, frosted, and water"}, {},
        [](const FValues&) { return BuildGlassScene(); }},
    {{"leaves", "SCATTERING=1", "a bower against the sun: leaves, a paper screen and a lantern; 0: no light scatters through them"},
        {{"SCATTERING", 1.0f, 0.0f, 1.0f}}, [](const FValues& P) { return BuildLeavesScene(P[0] >= 0.5f); }},
    {{"water", "SCATTERING=1", "a pond whose water scatters light, with a jetty and stones; 0: it does not"},
        {{"SCATTERING", 1.0f, 0.0f, 1.0f}}, [](const FValues& P) { return BuildWaterScene(P[0] >= 0.5f); }},
    {{"furnace", "ALBEDO=0.5", "closed room that emits 0.5; every pixel is 0.5/(1-albedo)"}, {{"ALBEDO", 0.5f, 0.0f, 0.99f}},
        [](const FValues& P) { return BuildFurnace(P[0]); }},
    {{"sphere", "ALBEDO=0.5", "inside of a diffuse sphere of 96 m^2 around 10,000 lm; irradiance 104.17/(1-albedo)"},
        {{"ALBEDO", 0.5f, 0.0f, 0.99f}}, [](const FValues& P) { return BuildSphere(P[0]); }},
    {{"polygonlight", "X=0", "unit square light 1 m above a floor of albedo 0.5, seen at the point X"}, {{"X", 0.0f, -10.0f, 10.0f}},
        [](const FValues& P) { return BuildPolygonLight(P[0]); }},
    {{"formfactors", "PERPENDICULAR=0", "two unit squares; the mean of a square picture is half their form factor"},
        {{"PERPENDICULAR", 0.0f, 0.0f, 1.0f}}, [](const FValues& P) { return BuildFormFactors(P[0] >= 0.5f); }},
    {{"disk", "HEIGHT=1", "disk light of radius 1 m above a floor of albedo 0.5, seen on its axis"}, {{"HEIGHT", 1.0f, 0.1f, 10.0f}},
        [](const FValues& P) { return BuildDisk(P[0]); }},
    {{"spherelight", "DISTANCE=2:ANGLE=0", "sphere light of radius 0.5 m over a floor of albedo 0.5"},
        {{"DISTANCE", 2.0f, 1.0f, 100.0f}, {"ANGLE", 0.0f, 0.0f, 75.0f}}, [](const FValues& P) { return BuildSphereLight(P[0], P[1]); }},
    {{"ggx", "ROUGHNESS=0.5:MU=0.7", "metal of F = 1 under a sky of 1; every pixel is the lobe's albedo at cosine MU"},
        {{"ROUGHNESS", 0.5f, 0.0f, 1.0f}, {"MU", 0.7f, 0.02f, 1.0f}}, [](const FValues& P) { return BuildGgx(P[0], P[1]); }},
    {{"penumbra", "HEIGHT=1", "straight edge over a floor, seen straight down; 4 penumbra widths high"}, {{"HEIGHT", 1.0f, 0.01f, 100.0f}},
        [](const FValues& P) { return BuildPenumbra(P[0]); }},
    {{"planes", "", "single-sided planes facing up and down, and a double-sided one, between sun and floor"}, {},
        [](const FValues&) { return BuildPlanes(); }},
    {{"emptysky", "", "nothing but sky"}, {}, [](const FValues&) { return BuildEmptySky(); }},
    {{"stability-wall", "CM=5:SLIT=0", "sealed dark room of 4 m under open sky, walls CM thick; 0: single faces"},
        {{"CM", 5.0f, 0.0f, 100.0f}, {"SLIT", 0.0f, 0.0f, 100.0f}}, [](const FValues& P) { return BuildStabilityWall(P[0], P[1]); }},
    {{"stability-time", "", "blocks on a plain, whose shadows tell the time of day"}, {},
        [](const FValues&) { return BuildStabilityTime(); }},
    {{"stability-candles", "", "dark hall with 24 candles of 1 cm^2"}, {}, [](const FValues&) { return BuildStabilityCandles(); }},
    {{"stability-poles", "LAMP=0", "ring of poles around the camera, before striped walls; 1: by a lamp"}, {{"LAMP", 0.0f, 0.0f, 1.0f}},
        [](const FValues& P) { return BuildStabilityPoles(P[0] >= 0.5f); }},
    {{"stability-ghost", "LAMP=0", "glowing cube that crosses a striped wall at 5 m/s; 1: by a lamp"}, {{"LAMP", 0.0f, 0.0f, 1.0f}},
        [](const FValues& P) { return BuildStabilityGhost(P[0] >= 0.5f); }},
    {{"stability-fan", "LAMP=0", "fan turning over a floor under a soft sun; 1: under a lamp"}, {{"LAMP", 0.0f, 0.0f, 1.0f}},
        [](const FValues& P) { return BuildStabilityFan(P[0] >= 0.5f); }},
    {{"stability-nan", "", "roughness 0, edge-on faces, triangles without area, a sun of 10^6 lux"}, {},
        [](const FValues&) { return BuildStabilityNan(); }},
    {{"stability-lid", "LAMP=0", "slab over a floor, to be taken away; 1: by a lamp"}, {{"LAMP", 0.0f, 0.0f, 1.0f}},
        [](const FValues& P) { return BuildStabilityLid(P[0] >= 0.5f); }},
    {{"stability-furnace", "", "spheres of roughness 0 to 1, dielectric and metal, under a sky of 1"}, {},
        [](const FValues&) { return BuildStabilityFurnace(); }},
    {{"stability-seams", "LAMPS=0", "wide penumbra over a floor: smooth, so that seams show; or rods in the light of LAMPS"},
        {{"LAMPS", 0.0f, 0.0f, 64.0f}}, [](const FValues& P) { return BuildStabilitySeams(P[0]); }},
    {{"stability-far", "FAR=1", "open room at FAR times (16 km, 0.5 km, 16 km)"}, {{"FAR", 1.0f, 0.0f, 1.0f}},
        [](const FValues& P) { return BuildStabilityFar(P[0]); }},
    {{"stability-materials", "", "wall of 200 quads with a material each"}, {}, [](const FValues&) { return BuildStabilityMaterials(); }},
    {{"stability-flat", "METAL=0", "plane that fills the picture: all pixels alike; 1: a mirror"}, {{"METAL", 0.0f, 0.0f, 1.0f}},
        [](const FValues& P) { return BuildStabilityFlat(P[0] >= 0.5f); }},
    {{"stability-edge", "DISTANCE=3", "table in the sun with a dark underside, seen from DISTANCE metres"},
        {{"DISTANCE", 3.0f, 0.5f, 60.0f}}, [](const FValues& P) { return BuildStabilityEdge(P[0]); }},
    {{"stability-temple", "", "chamber that the sun reaches by five bounces"}, {}, [](const FValues&) { return BuildStabilityTemple(); }},
    {{"stability-switch", "PERIOD=4", "room with one lamp: on for half a PERIOD of seconds, then off"}, {{"PERIOD", 4.0f, 0.1f, 1000.0f}},
        [](const FValues& P) { return BuildStabilitySwitch(P[0]); }},
    {{"stability-flicker", "", "32 lamps that flicker at 5 and 15 Hz"}, {}, [](const FValues&) { return BuildStabilityFlicker(); }},
    {{"stability-boiling", "", "hall with 640 lamps in which nothing moves"}, {}, [](const FValues&) { return BuildStabilityBoiling(); }},
    {{"stability-mirror", "", "cube that flies past a flat and a convex mirror"}, {},
        [](const FValues&) { return BuildStabilityMirror(); }},
    {{"stability-railing", "ROWS=180:LAMPS=0", "railing of metal, its bars a pixel wide in a picture of ROWS; with lamps, at night"},
        {{"ROWS", 180.0f, 16.0f, 4320.0f}, {"LAMPS", 0.0f, 0.0f, 1000.0f}},
        [](const FValues& P) { return BuildStabilityRailing(P[0], int(P[1])); }},
    {{"stability-hugemesh", "", "one mesh of 2 km and 2,000 small ones"}, {}, [](const FValues&) { return BuildStabilityHugeMesh(); }},
    {{"stability-hash", "", "street of 2 km that the camera flies through at 200 m/s"}, {},
        [](const FValues&) { return BuildStabilityHash(); }},
    {{"stability-lightgrid", "RANGE=0", "640 lamps in a grid over a flat floor, that shine RANGE metres far; 0: without end"},
        {{"RANGE", 0.0f, 0.0f, 1000.0f}}, [](const FValues& P) { return BuildStabilityLightGrid(P[0]); }},
    {{"stability-caustics", "", "pool of liquid metal whose waves reflect the sun to a wall"}, {},
        [](const FValues&) { return BuildStabilityCaustics(); }},
    {{"stability-toon", "", "smooth shapes in light from walls only, for a ramp of three bands"}, {},
        [](const FValues&) { return BuildStabilityToon(); }},
    {{"stability-door", "", "dark corridor beside a lit room, with a door between them"}, {},
        [](const FValues&) { return BuildStabilityDoor(); }},
    {{"stability-mirrorroom", "BRIGHTNESS=1", "room with three walls of mirrors and a lamp"}, {{"BRIGHTNESS", 1.0f, 0.0f, 10.0f}},
        [](const FValues& P) { return BuildStabilityMirrorRoom(P[0]); }},
    {{"stability-torch", "", "torch that is carried through a dark corridor at 5 m/s"}, {},
        [](const FValues&) { return BuildStabilityTorch(); }},
    {{"stability-streaming", "", "street at night that glowing objects are streamed into"}, {},
        [](const FValues&) { return BuildStabilityStreaming(); }},
    {{"stability-fog", "", "dark hall, shaft of sun, sliding board, and a sealed chamber"}, {},
        [](const FValues&) { return BuildStabilityFog(); }},
};

const FEntry* FindEntry(std::string_view NameWithParameters)
{
	const std::string_view Name = NameWithParameters.substr(0, NameWithParameters.find(':'));
	for (const FEntry& Entry : Entries)
	{
		if (Name == Entry.Info.Name) { return &Entry; }
	}
	return nullptr;
}

/// Fills OutValues, or returns what is wrong.
std::string ParseParameters(const FEntry& Entry, std::string_view Text, FValues& OutValues)
{
	for (size_t I = 0; I < MostParameters; ++I) { OutValues[I] = Entry.Parameters[I].Default; }
	for (size_t I = 0; !Text.empty(); ++I)
	{
		Text.remove_prefix(1); // the colon
		const std::string_view Word = Text.substr(0, Text.find(':'));
		Text.remove_prefix(Word.size());
		if (I >= MostParameters || Entry.Parameters[I].Name == nullptr) { return fmt::format("{} is one parameter too many", Quote(Word)); }
		const FParameter& Parameter = Entry.Parameters[I];
		float Value = 0.0f;
		const auto [End, Error] = std::from_chars(Word.data(), Word.data() + Word.size(), Value);
		if (Error != std::errc() || End != Word.data() + Word.size() || !(Value >= Parameter.Min) || !(Value <= Parameter.Max))
		{
			return fmt::format("{} is {}, expected a number from {} to {}", Parameter.Name, Quote(Word), Parameter.Min, Parameter.Max);
		}
		OutValues[I] = Value;
	}
	return {};
}

} // namespace

std::span<const FBuiltinSceneInfo> GetBuiltinScenes()
{
	static const std::vector<FBuiltinSceneInfo> Infos = [] {
		std::vector<FBuiltinSceneInfo> Result;
		for (const FEntry& Entry : Entries) { Result.push_back(Entry.Info); }
		return Result;
	}();
	return Infos;
}

std::string GetBuiltinSceneNames()
{
	std::string Names;
	for (const FBuiltinSceneInfo& Info : GetBuiltinScenes())
	{
		// The scenes of the stability suite are too many for a message.
		if (std::string_view(Info.Name).starts_with("stability-")) { continue; }
		Names += (Names.empty() ? "" : ", ") + std::string(Info.Name);
	}
	return Names + " and those of lantern render --list";
}

bool IsBuiltinScene(std::string_view NameWithParameters) { return FindEntry(NameWithParameters) != nullptr; }

FLoadResult BuildBuiltinScene(const std::string& NameWithParameters)
{
	const FEntry* Entry = FindEntry(NameWithParameters);
	if (Entry == nullptr)
	{
		return {
		    std::nullopt, fmt::format("{}: no such built-in scene; there are {}", EscapePath(NameWithParameters), GetBuiltinSceneNames())};
	}
	const size_t Colon = NameWithParameters.find(':');
	const std::string_view Text = Colon == std::string::npos ? std::string_view() : std::string_view(NameWithParameters).substr(Colon);
	FValues Values{};
	const std::string Error = ParseParameters(*Entry, Text, Values);
	if (!Error.empty()) { return {std::nullopt, fmt::format("{}: {}", EscapePath(NameWithParameters), Error)}; }
	FLoadResult Result;
	Result.Scene = Entry->Build(Values);
	Result.Scene->Name = NameWithParameters;
	return Result;
}

} // namespace Lantern

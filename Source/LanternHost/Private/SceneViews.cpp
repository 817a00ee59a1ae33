// Reads views.json, and checks what a view may be made of.
#include "LanternHost/SceneViews.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "Gltf/GltfFile.h"
#include "LanternCore/Text/Quote.h"

namespace Lantern
{

namespace
{
namespace fs = std::filesystem;

constexpr double MaxNumber = 1e15; // beyond it, squares overflow in fp32
constexpr const char* BeyondMaxNumber = "holds a number beyond 1e15";
constexpr uint64_t MaxFileBytes = uint64_t(16) << 20;
constexpr size_t MaxLineLength = 600;
constexpr std::array KnownMembers = {"name", "camera", "sun", "sky", "sceneLights"};

bool IsTooLarge(const glm::dvec3& V) { return !glm::all(glm::lessThanEqual(glm::abs(V), glm::dvec3(MaxNumber))); }

void RequireNone(const Gltf::FJson& Place, const std::string& Complaint)
{
	if (!Complaint.empty()) { Place.Fail(Complaint); }
}

/// Reads an array of exactly Size numbers. Returns false if there is none.
template <size_t Size>
bool GetNumbers(const Gltf::FJson& View, const char* Key, std::array<double, Size>& Out)
{
	const Gltf::FJson List = View.Member(Key);
	if (!List.Exists()) { return false; }
	if (List.Count() != Size) { List.Fail(fmt::format("expected {} numbers, found {}", Size, List.Count())); }
	for (size_t I = 0; I < Size; ++I) { Out[I] = List.Element(I).ToNumber(); }
	return true;
}

FSceneView ReadView(const Gltf::FJson& Json)
{
	Json.RequireObject();
	FSceneView View;
	View.Name = Json.GetString("name", "");
	if (View.Name.empty()) { Json.Fail("a view needs a name"); }
	if (std::array<double, 7> N; GetNumbers(Json, "camera", N))
	{
		View.Camera = FViewCamera{{N[0], N[1], N[2]}, {N[3], N[4], N[5]}, N[6]};
		RequireNone(Json.Member("camera"), CheckViewCamera(*View.Camera));
	}
	if (std::array<double, 5> N; GetNumbers(Json, "sun", N))
	{
		View.Sun = FViewSun{N[0], {N[1], N[2], N[3]}, N[4]};
		RequireNone(Json.Member("sun"), CheckViewSun(*View.Sun));
	}
	if (std::array<double, 3> N; GetNumbers(Json, "sky", N))
	{
		View.Sky = glm::dvec3(N[0], N[1], N[2]);
		RequireNone(Json.Member("sky"), CheckViewSky(*View.Sky));
	}
	View.bSceneLights = Json.GetBool("sceneLights", true);
	return View;
}

/// Reads the views of Key into Out. Returns whether the file lists it.
bool ReadViews(const fs::path& File, const std::string& Key, FSceneViews& Out)
{
	const std::vector<uint8_t> Data = Gltf::ReadFile(File, MaxFileBytes);
	const nlohmann::json Document = Gltf::ParseJson({reinterpret_cast<const char*>(Data.data()), Data.size()});
	const Gltf::FJson Root(Document);
	Root.RequireObject();
	const Gltf::FJson List = Root.Member(Key.c_str());
	if (!List.Exists()) { return false; }
	for (size_t I = 0; I < List.Count(); ++I)
	{
		const Gltf::FJson Json = List.Element(I);
		FSceneView View = ReadView(Json);
		if (Out.Find(View.Name)) { Json.Fail(fmt::format("there is another view {}", Quote(View.Name))); }
		Out.Views.push_back(std::move(View));
		for (const auto& [Name, Value] : Document[Key][I].items())
		{
			const bool bKnown = Name.starts_with('_') || std::find(KnownMembers.begin(), KnownMembers.end(), Name) != KnownMembers.end();
			if (bKnown) { continue; }
			Out.Warnings.push_back(EscapeText(
			    fmt::format("{}: {}: {} is no part of a view", EscapePath(File.string()), Json.GetPath(), Quote(Name)), MaxLineLength));
		}
	}
	return true;
}
} // namespace

std::string CheckViewCamera(const FViewCamera& Camera)
{
	if (IsTooLarge(Camera.Position) || IsTooLarge(Camera.Target)) { return BeyondMaxNumber; }
	if (Camera.Position == Camera.Target) { return "position and target are the same point"; }
	return Camera.FovY > 0.0 && Camera.FovY < 180.0 ? "" : "the field of view must lie between 0 and 180 degrees";
}

std::string CheckViewSun(const FViewSun& Sun)
{
	if (IsTooLarge(Sun.Direction) || !(Sun.Irradiance <= MaxNumber)) { return BeyondMaxNumber; }
	if (Sun.Irradiance < 0.0) { return "the irradiance must not be negative"; }
	if (glm::length(Sun.Direction) < 1e-12) { return "the direction has no length"; }
	return Sun.Diameter >= 0.0 && Sun.Diameter <= 180.0 ? "" : "the diameter must lie between 0 and 180 degrees";
}

std::string CheckViewSky(const glm::dvec3& Sky)
{
	if (IsTooLarge(Sky)) { return BeyondMaxNumber; }
	return glm::all(glm::greaterThanEqual(Sky, glm::dvec3(0))) ? "" : "radiance must not be negative";
}

const FSceneView* FSceneViews::Find(std::string_view Name) const
{
	const auto Found = std::find_if(Views.begin(), Views.end(), [&](const FSceneView& View) { return View.Name == Name; });
	return Found == Views.end() ? nullptr : &*Found;
}

std::string FSceneViews::ListNames() const
{
	std::string Out;
	for (const FSceneView& View : Views) { Out += (Out.empty() ? "" : ", ") + EscapeText(View.Name); }
	return Out;
}

FSceneViews LoadSceneViews(const std::string& SceneFile)
{
	std::error_code Error;
	// Not canonical: a link to a scene stands for the scene in the folder of the link.
	const fs::path Scene = fs::absolute(SceneFile, Error).lexically_normal();
	fs::path Folder = Scene.parent_path();
	for (int Level = 0; Level < 2; ++Level, Folder = Folder.parent_path())
	{
		const fs::path File = Folder / "views.json";
		if (!fs::exists(File, Error)) { continue; }
		FSceneViews Out;
		try
		{
			if (!ReadViews(File, Scene.lexically_relative(Folder).generic_string(), Out)) { continue; }
		}
		catch (const std::exception& Exception)
		{
			Out.Views.clear();
			Out.Error = EscapeText(fmt::format("{}: {}", EscapePath(File.string()), Exception.what()), MaxLineLength);
		}
		Out.File = File.string();
		return Out;
	}
	return {};
}

} // namespace Lantern

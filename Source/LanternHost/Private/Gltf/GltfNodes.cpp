// Nodes, cameras and lights. The hierarchy is walked without recursion: it may be a million deep.
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "Gltf/GltfDocument.h"
#include "LanternCore/Text/Quote.h"

namespace Lantern::Gltf
{

namespace
{

/// Parent of each node in the file; −1: a root. Throws on a second parent.
std::vector<int32_t> ReadParents(const FJson& Nodes)
{
	const size_t Count = Nodes.Count();
	std::vector<int32_t> Parents(Count, -1);
	for (size_t I = 0; I < Count; ++I)
	{
		const FJson Json = Nodes.Element(I);
		const FJson Children = Json.Member("children");
		for (size_t C = 0; C < Children.Count(); ++C)
		{
			const FJson Child = Children.Element(C);
			const uint64_t Index = Child.ToUInt(UINT64_MAX);
			if (Index >= Count) { Child.Fail(fmt::format("there is no node {} (there are {})", Index, Count)); }
			if (Parents[Index] >= 0) { Child.Fail(fmt::format("node {} is already a child of node {}", Index, Parents[Index])); }
			Parents[Index] = int32_t(I);
		}
	}
	return Parents;
}

/// Nodes in an order in which parents come first. Throws on a cycle.
std::vector<int32_t> OrderNodes(const FJson& Nodes, const std::vector<int32_t>& Parents)
{
	std::vector<int32_t> Order;
	Order.reserve(Parents.size());
	for (size_t I = 0; I < Parents.size(); ++I)
	{
		if (Parents[I] < 0) { Order.push_back(int32_t(I)); }
	}
	std::vector<bool> bVisited(Parents.size(), false);
	for (size_t Next = 0; Next < Order.size(); ++Next)
	{
		bVisited[size_t(Order[Next])] = true;
		const FJson Json = Nodes.Element(size_t(Order[Next]));
		const FJson Children = Json.Member("children");
		for (size_t C = 0; C < Children.Count(); ++C) { Order.push_back(int32_t(Children.Element(C).ToUInt(INT32_MAX))); }
	}
	for (size_t I = 0; I < Parents.size(); ++I)
	{
		if (!bVisited[I])
		{
			const FJson Json = Nodes.Element(I);
			Json.Fail("is part of a cycle");
		}
	}
	return Order;
}

/// Which nodes belong to the scene that is shown: the file's default, else its first, else all.
std::vector<bool> FindShown(FDocument& Document, const std::vector<int32_t>& Parents, const std::vector<int32_t>& Order)
{
	const FJson Scenes = Document.Root.Member("scenes");
	std::vector<bool> bShown(Parents.size(), Scenes.Count() == 0);
	const int32_t Default = Document.Root.GetIndex("scene", Scenes.Count(), "scene");
	if (Scenes.Count() == 0) { return bShown; }
	const FJson Scene = Scenes.Element(size_t(std::max(Default, 0)));
	const FJson Roots = Scene.Member("nodes");
	for (size_t I = 0; I < Roots.Count(); ++I)
	{
		const FJson Root = Roots.Element(I);
		const uint64_t Index = Root.ToUInt(UINT64_MAX);
		if (Index >= Parents.size()) { Root.Fail(fmt::format("there is no node {} (there are {})", Index, Parents.size())); }
		if (Parents[Index] >= 0) { Root.Fail(fmt::format("node {} is no root: it is a child of node {}", Index, Parents[Index])); }
		bShown[Index] = true;
	}
	for (const int32_t Node : Order)
	{
		if (Parents[size_t(Node)] >= 0) { bShown[size_t(Node)] = bShown[size_t(Parents[size_t(Node)])]; }
	}
	return bShown;
}

glm::quat ReadRotation(const FJson& Json)
{
	const glm::dvec4 V(Json.GetVec4("rotation", glm::vec4(0, 0, 0, 1)));
	const double Length = glm::length(V);
	if (!(Length > 1e-12)) { Json.Fail("rotation has no length"); }
	return glm::quat(glm::dquat(V.w, V.x, V.y, V.z) / Length);
}

void ReadTransform(const FJson& Json, FHostNode& Node)
{
	double M[16];
	if (Json.GetNumbers("matrix", 16, M))
	{
		glm::dmat4 Matrix;
		for (int I = 0; I < 16; ++I) { Matrix[I / 4][I % 4] = M[I]; }
		Node.Matrix = Matrix;
	}
	Node.Translation = glm::dvec3(Json.GetVec3("translation", glm::vec3(0)));
	Node.Rotation = ReadRotation(Json);
	Node.Scale = Json.GetVec3("scale", glm::vec3(1));
}

void ReadCameras(FDocument& Document, std::vector<int32_t>& OutRemap)
{
	const FJson Cameras = Document.Root.Member("cameras");
	for (size_t I = 0; I < Cameras.Count(); ++I)
	{
		const FJson Json = Cameras.Element(I);
		const FJson Perspective = Json.Member("perspective");
		if (!Perspective.Exists())
		{
			Document.Warn("orthographic cameras are not read");
			OutRemap.push_back(-1);
			continue;
		}
		FHostCamera Camera;
		Camera.FovY = Perspective.GetFloat("yfov", 1.0f);
		Camera.Near = Perspective.GetFloat("znear", 0.1f);
		if (!(Camera.FovY > 0.0f && Camera.FovY < 3.1415f) || !(Camera.Near > 0.0f))
		{
			Perspective.Fail(fmt::format("yfov {} or znear {} makes no view", Camera.FovY, Camera.Near));
		}
		OutRemap.push_back(int32_t(Document.Scene.Cameras.size()));
		Document.Scene.Cameras.push_back(Camera);
	}
}

float ReadLength(const FJson& Json, const char* Name)
{
	constexpr float Most = 1e6f;
	const float Length = Json.GetFloat(Name, 0.0f);
	if (!(Length > 0.0f && Length <= Most)) { Json.Fail(fmt::format("its {} is not above 0 and at most 1e6 m", Name)); }
	return Length;
}

FPhotometry ReadPhotometry(const FDocument& Document, const FJson& Uri)
{
	constexpr uint64_t MostBytes = 16u << 20;
	const std::string& Text = Uri.ToString();
	std::vector<uint8_t> Bytes;
	std::string Name = "data";
	if (IsDataUri(Text)) { Bytes = DecodeDataUri(Uri, Text); }
	else
	{
		const std::filesystem::path Path = ResolveUri(Uri, Text, Document.Folder);
		Name = Path.filename().string();
		try
		{
			Bytes = ReadFile(Path, MostBytes);
		}
		catch (const FError& Error)
		{
			Uri.Fail(fmt::format("'{}' {}", EscapePath(Path.string()), Error.what()));
		}
	}
	FPhotometry Table;
	const FRTStatus Status = ParseIes({reinterpret_cast<const char*>(Bytes.data()), Bytes.size()}, Name, Table);
	if (!Status) { Uri.Fail(Status.Message); }
	return Table;
}

/// Reads the profile of a point light or spot. Lights share those of one file.
void ReadProfile(FDocument& Document, const FJson& Given, FHostLight& Light)
{
	const FJson Uri = Given.Member("ies");
	if (!Uri.Exists()) { return; }
	if (Light.Type != LIGHT_POINT) { Uri.Fail("only point lights and spots without a shape have a profile"); }
	const auto [Found, bNew] = Document.ProfileIndices.try_emplace(Uri.ToString(), Document.Scene.Profiles.size());
	if (bNew) { Document.Scene.Profiles.push_back(MakeProfileGrid(ReadPhotometry(Document, Uri))); }
	Light.Profile = static_cast<uint32_t>(Found->second) + 1;
	if (!Given.GetBool("iesIntensity", false)) { return; }
	Light.Color *= Document.Scene.Profiles[Found->second].Peak;
	if (!glm::all(glm::lessThan(Light.Color, glm::vec3(1e30f)))) { Given.Fail("the light is brighter than a float holds"); }
}

/// Reads the shape of a light: extras.lantern of a light of KHR_lights_punctual. Loaders that do not know it see the light without
/// extent. Candela are those along the axis, or across a tube.
void ReadLightShape(const FJson& Json, FHostLight& Light)
{
	constexpr float Pi = 3.14159265f;
	const FJson Shape = Json.Extra("lantern");
	if (!Shape.Exists()) { return; }
	Light.bCastsShadow = Shape.GetBool("castsShadow", true);
	Light.bTwoSided = Shape.GetBool("twoSided", false);
	Light.bLightsFog = Shape.GetBool("lightsFog", true);
	Light.Channels = static_cast<uint8_t>(Shape.GetUInt("channels", CHANNELS_DEFAULT, 255));
	if (Light.Type == LIGHT_DIRECTIONAL)
	{
		Light.Size.x = glm::clamp(Shape.GetFloat("angularDiameter", 0.0f), 0.0f, Pi);
		return;
	}
	const std::string Name = Shape.GetString("shape", "");
	float Area = 1.0f; // as seen from where the candela are given
	if (Name == "rectangle")
	{
		Light.Type = LIGHT_RECTANGLE;
		Light.Size = {ReadLength(Shape, "width"), ReadLength(Shape, "height")};
		Area = Light.Size.x * Light.Size.y;
	}
	else if (Name == "disk" || Name == "sphere")
	{
		Light.Type = Name == "disk" ? LIGHT_DISK : LIGHT_SPHERE;
		Light.Size.x = ReadLength(Shape, "radius");
		Area = Pi * Light.Size.x * Light.Size.x;
	}
	else if (Name == "tube")
	{
		Light.Type = LIGHT_TUBE;
		Light.Size = {ReadLength(Shape, "radius"), ReadLength(Shape, "length")};
		Area = 2.0f * Light.Size.x * Light.Size.y + Pi * Light.Size.x * Light.Size.x;
	}
	else if (!Name.empty()) { Shape.Fail(fmt::format("{} is no shape of a light", Quote(Name))); }
	Light.Color /= Area;
	if (!glm::all(glm::lessThan(Light.Color, glm::vec3(1e30f)))) { Shape.Fail("the light is brighter than a float holds"); }
}

FHostLight ReadLight(FDocument& Document, const FJson& Json)
{
	FHostLight Light;
	Light.Name = Json.GetString("name", "");
	const std::string Type = Json.GetString("type", "");
	if (Type != "point" && Type != "spot" && Type != "directional") { Json.Fail(fmt::format("{} is no type of light", Quote(Type))); }
	Light.Type = Type == "directional" ? LIGHT_DIRECTIONAL : LIGHT_POINT;
	Light.Color = glm::max(Json.GetVec3("color", glm::vec3(1)), glm::vec3(0)) * std::max(Json.GetFloat("intensity", 1.0f), 0.0f);
	if (!glm::all(glm::lessThan(Light.Color, glm::vec3(1e30f)))) { Json.Fail("its intensity is beyond what a float holds"); }
	Light.Range = std::max(Json.GetFloat("range", 0.0f), 0.0f);
	if (Type == "spot")
	{
		const FJson Spot = Json.Member("spot");
		constexpr float QuarterTurn = 1.5707963268f;
		Light.OuterCone = glm::clamp(Spot.GetFloat("outerConeAngle", 0.7853981634f), 1e-4f, QuarterTurn);
		Light.InnerCone = glm::clamp(Spot.GetFloat("innerConeAngle", 0.0f), 0.0f, Light.OuterCone);
	}
	ReadLightShape(Json, Light);
	const FJson Given = Json.Extra("lantern");
	if (Given.Exists()) { ReadProfile(Document, Given, Light); }
	return Light;
}

void ReadLights(FDocument& Document)
{
	const FJson Extension = Document.Root.Extension("KHR_lights_punctual");
	const FJson Lights = Extension.Member("lights");
	for (size_t I = 0; I < Lights.Count(); ++I)
	{
		const FJson Json = Lights.Element(I);
		Document.Scene.Lights.push_back(ReadLight(Document, Json));
	}
}

/// Reads extras.lantern of a node: who sees its mesh, and what it casts shadows on.
void ReadTraits(const FJson& Json, FRTObjectTraits& Traits)
{
	const FJson Given = Json.Extra("lantern");
	if (!Given.Exists()) { return; }
	Traits.bVisible = Given.GetBool("visible", true);
	Traits.bCastsShadow = Given.GetBool("castsShadow", true);
	Traits.bCastsLocalShadow = Given.GetBool("castsLocalShadow", true);
	Traits.bCharacter = Given.GetBool("character", false);
	Traits.Channels = static_cast<uint8_t>(Given.GetUInt("channels", CHANNELS_DEFAULT, 255));
}

/// Reads extras.lantern.toon of a node.
std::optional<FToonStyle> ReadToon(const FJson& Json)
{
	const FJson Extras = Json.Extra("lantern");
	const FJson Given = Extras.Member("toon");
	if (!Given.Exists()) { return std::nullopt; }
	FToonStyle Style;
	const auto Read = [&](const char* Name, float Default, float Max) {
		const float Value = Given.GetFloat(Name, Default);
		if (!(Value >= 0.0f && Value <= Max)) { Given.Fail(fmt::format("{} is {}, expected a number from 0 to {}", Name, Value, Max)); }
		return Value;
	};
	Style.Center = Given.GetVec3("center", Style.Center);
	Style.SphereWeight = Read("sphereWeight", Style.SphereWeight, 1.0f);
	Style.Bend = Read("bend", Style.Bend, 1.0f);
	Style.MaxSaturation = Read("maxSaturation", Style.MaxSaturation, 1.0f);
	Style.MaxValue = Read("maxValue", Style.MaxValue, 1.0e6f);
	Style.Occlusion = Read("occlusion", Style.Occlusion, 1.0f);
	Style.Tint = Given.GetVec3("tint", Style.Tint);
	if (Style.Tint != glm::max(Style.Tint, glm::vec3(0)) || Style.Tint == glm::vec3(0)) { Given.Fail("tint is black or negative"); }
	return Style;
}

FHostNode ReadNode(FDocument& Document, const FJson& Json, bool bShown, const std::vector<int32_t>& CameraRemap)
{
	FHostNode Node;
	Node.Name = Json.GetString("name", "");
	ReadTransform(Json, Node);
	ReadTraits(Json, Node.Traits);
	Node.Toon = ReadToon(Json);
	const int32_t Mesh = Json.GetIndex("mesh", Document.MeshRemap.size(), "mesh");
	const int32_t Camera = Json.GetIndex("camera", CameraRemap.size(), "camera");
	const FJson LightJson = Json.Extension("KHR_lights_punctual");
	const int32_t Light = LightJson.GetIndex("light", Document.Scene.Lights.size(), "light");
	const FJson Skins = Document.Root.Member("skins");
	const int32_t Skin = Json.GetIndex("skin", Skins.Count(), "skin");
	if (bShown)
	{
		Node.Mesh = Mesh >= 0 ? Document.MeshRemap[size_t(Mesh)] : -1;
		Node.Camera = Camera >= 0 ? CameraRemap[size_t(Camera)] : -1;
		Node.Light = Light;
		Node.Skin = Node.Mesh >= 0 ? Skin : -1;
	}
	return Node;
}

/// One child node per instance. The attributes are those of the extension; scales and rotations default as in nodes.
void ExpandInstances(FDocument& Document, const FJson& NodeJson, int32_t NodeIndex)
{
	const FJson Extension = NodeJson.Extension("EXT_mesh_gpu_instancing");
	FSceneDescription& Scene = Document.Scene;
	if (!Extension.Exists() || Scene.Nodes[size_t(NodeIndex)].Mesh < 0) { return; }
	const FJson Attributes = Extension.Member("attributes");
	size_t Count = 0;
	const auto Read = [&](const char* Name, uint32_t Components, const glm::vec4& Fill) {
		const int32_t Index = Attributes.GetIndex(Name, Document.Accessors.size(), "accessor");
		if (Index < 0) { return std::vector<glm::vec4>(); }
		const FAccessor& Accessor = Document.Accessors[size_t(Index)];
		if (Accessor.Components != Components || (Count != 0 && Accessor.Count != Count) || Accessor.Count == 0)
		{
			Attributes.Fail(fmt::format("{} has the wrong type or count", Name));
		}
		Document.ChargeGeometry(Attributes, Accessor.Count, sizeof(FHostNode));
		Count = Accessor.Count;
		return ReadVec4(Accessor, Fill);
	};
	const auto Translations = Read("TRANSLATION", 3, glm::vec4(0));
	const auto Rotations = Read("ROTATION", 4, glm::vec4(0));
	const auto Scales = Read("SCALE", 3, glm::vec4(0));
	if (Scene.Nodes.size() + Count > Document.Options.MaxNodes)
	{
		Attributes.Fail(fmt::format("more than {} nodes", Document.Options.MaxNodes));
	}
	for (size_t I = 0; I < Count; ++I)
	{
		FHostNode Node;
		Node.Parent = NodeIndex;
		Node.Mesh = Scene.Nodes[size_t(NodeIndex)].Mesh;
		Node.Translation = Translations.empty() ? glm::dvec3(0) : glm::dvec3(Translations[I]);
		Node.Scale = Scales.empty() ? glm::vec3(1) : glm::vec3(Scales[I]);
		if (!Rotations.empty())
		{
			const glm::dvec4 V(Rotations[I]);
			const double Length = glm::length(V);
			if (!(Length > 1e-12) || !std::isfinite(Length)) { Attributes.Fail(fmt::format("ROTATION {} is no rotation", I)); }
			Node.Rotation = glm::quat(glm::dquat(V.w, V.x, V.y, V.z) / Length);
		}
		Scene.Nodes.push_back(Node);
	}
	Scene.Nodes[size_t(NodeIndex)].Mesh = -1;
	Scene.Nodes[size_t(NodeIndex)].Skin = -1;
}

} // namespace

void ReadNodes(FDocument& Document)
{
	ReadLights(Document);
	std::vector<int32_t> CameraRemap;
	ReadCameras(Document, CameraRemap);

	const FJson Nodes = Document.Root.Member("nodes");
	if (Nodes.Count() > Document.Options.MaxNodes) { Nodes.Fail(fmt::format("more than {} nodes", Document.Options.MaxNodes)); }
	const std::vector<int32_t> Parents = ReadParents(Nodes);
	const std::vector<int32_t> Order = OrderNodes(Nodes, Parents);
	const std::vector<bool> bShown = FindShown(Document, Parents, Order);
	Document.NodeRemap.assign(Order.size(), -1);
	Document.Scene.Nodes.reserve(Order.size());
	for (size_t I = 0; I < Order.size(); ++I)
	{
		const size_t Source = size_t(Order[I]);
		const FJson Json = Nodes.Element(Source);
		Document.NodeRemap[Source] = int32_t(I);
		FHostNode Node = ReadNode(Document, Json, bShown[Source], CameraRemap);
		Node.Parent = Parents[Source] >= 0 ? Document.NodeRemap[size_t(Parents[Source])] : -1;
		Document.Scene.Nodes.push_back(std::move(Node));
	}
	for (size_t I = 0; I < Order.size(); ++I)
	{
		const FJson Json = Nodes.Element(size_t(Order[I]));
		ExpandInstances(Document, Json, int32_t(I));
	}
}

} // namespace Lantern::Gltf

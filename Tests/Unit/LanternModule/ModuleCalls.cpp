// The calls that a play knows, one row each. What a choice may not be is named as the error must name it.
#include <algorithm>
#include <array>

#include "ModuleCallsAssets.h"
#include "ModulePlay.h"

namespace Lantern
{

namespace
{

constexpr float Positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
constexpr float Normals[] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
constexpr float Tangents[] = {1, 0, 0, 1, 1, 0, 0, -1, 1, 0, 0, 1, 1, 0, 0, 1};
constexpr uint8_t Colors[] = {255, 0, 0, 255, 0, 255, 0, 128, 0, 0, 255, 0, 9, 9, 9, 9};
constexpr float UVs[] = {0, 0, 1, 0, 0, 1, 1, 1};

FRTModuleMap MakeMap(FModulePlay& Play, const char* Name)
{
	FRTModuleMap Map;
	if (!Play.Bool(true)) { return Map; }
	Map.Texture = Play.SampledTexture(Name);
	if (Map.Texture == nullptr) { return Map; }
	Map.Sampler = Play.Pointer(Name, Play.GetSampler());
	Map.UVSet = Play.Index(Name, 1);
	Map.UVMatrix[0] = Play.Float(Name, 2.0f);
	Map.UVOffset[1] = Play.Float(Name, 0.5f);
	return Map;
}

FRTModuleMaterial MakeMaterial(FModulePlay& Play)
{
	FRTModuleMaterial Material;
	for (float& Channel : Material.BaseColor) { Channel = Play.Float("BaseColor", 0.5f); }
	for (float& Channel : Material.Emissive) { Channel = Play.Float("Emissive", 0.0f); }
	Material.Metallic = Play.Float("Metallic", 0.0f);
	Material.Roughness = Play.Float("Roughness", 1.0f);
	Material.AlphaCutoff = Play.Float("AlphaCutoff", 0.5f);
	Material.bMasked = Play.Bool(false);
	Material.bDoubleSided = Play.Bool(false);
	Material.NormalScale = Play.Float("NormalScale", 1.0f);
	Material.OcclusionStrength = Play.Float("OcclusionStrength", 1.0f);
	Material.Ior = Play.Float("Ior", 1.5f);
	Material.Specular = Play.Float("Specular", 1.0f);
	Material.Transmission = Play.Float("Transmission", 0.0f);
	for (float& Channel : Material.EmissiveMapMean) { Channel = Play.Float("EmissiveMapMean", 1.0f); }
	Material.BaseColorMap = MakeMap(Play, "BaseColorMap");
	Material.MetallicRoughnessMap = MakeMap(Play, "MetallicRoughnessMap");
	Material.NormalMap = MakeMap(Play, "NormalMap");
	Material.OcclusionMap = MakeMap(Play, "OcclusionMap");
	Material.EmissiveMap = MakeMap(Play, "EmissiveMap");
	for (float& Channel : Material.LightEmissive) { Channel = Play.Float("LightEmissive", 0.0f); }
	Material.bLightEmissive = Play.Bool(false);
	return Material;
}

FRTStatus AddMaterial(FModulePlay& Play)
{
	ERTMaterialHandle Added = ERTMaterialHandle::None;
	const FRTModuleMaterial Material = MakeMaterial(Play);
	const FRTStatus Status = Play.GetRenderer().AddMaterial(Material, Play.Pointer("Out", &Added));
	Play.Keep(Play.Materials, Added);
	return Status;
}

FRTStatus SetMaterial(FModulePlay& Play)
{
	const ERTMaterialHandle Handle = Play.Handle("material", Play.Materials);
	return Play.GetRenderer().SetMaterial(Handle, MakeMaterial(Play));
}

FRTStatus RemoveMaterial(FModulePlay& Play)
{
	const ERTMaterialHandle Handle = Play.Handle("material", Play.Materials);
	const FRTStatus Status = Play.GetRenderer().RemoveMaterial(Handle);
	if (Status) { Play.Forget(Play.Materials, Handle); }
	return Status;
}

FRTStatus AddAnyMesh(FModulePlay& Play, bool bDeformable, TPlayHandles<ERTMeshHandle>& To)
{
	std::array<FRTModuleSection, 2> Sections = {FRTModuleSection{0, 3, true}, FRTModuleSection{3, 3, true}};
	const std::array<uint32_t, 6> Indices = {0, 1, 2, 2, 1, Play.Index("index", 3)};
	FRTModuleMesh Mesh;
	Mesh.Name = Play.Pointer("Name", "Mesh");
	Mesh.Positions = Play.Floats("osition", Positions, false);
	Mesh.Normals = Play.Floats("normal", Normals, true);
	Mesh.UVs = Play.Floats("texture coordinate", UVs, true);
	Mesh.UVs1 = Play.Floats("texture coordinate", UVs, true);
	Mesh.Tangents = Play.Floats("tangent", Tangents, true);
	Mesh.VertexCount = Play.Count("VertexCount", 4);
	const bool bIndices16 = Play.Bool(false);
	std::array<uint16_t, 6> Indices16{};
	std::transform(Indices.begin(), Indices.end(), Indices16.begin(), [](uint32_t Index) { return static_cast<uint16_t>(Index); });
	if (bIndices16) { Mesh.Indices16 = Play.Pointer("Indices", Indices16.data()); }
	else { Mesh.Indices = Play.Pointer("Indices", Indices.data()); }
	Mesh.Colors = Play.Bool(false) ? Colors : nullptr;
	Mesh.IndexCount = Play.Count("IndexCount", 6);
	if (Play.Bool(true))
	{
		Sections[0].FirstIndex = Play.Index("section", 0);
		Sections[0].IndexCount = Play.Count("section", 3);
		Sections[1].bMayBeMasked = Play.Bool(true);
		Mesh.Sections = Sections.data();
		Mesh.SectionCount = Play.Count("section", 2);
	}
	Mesh.bDeformable = bDeformable;
	for (float& Axis : Mesh.BoundsCenter) { Axis = Play.Float("BoundsCenter", 0.0f); }
	Mesh.BoundsRadius = Play.Float("BoundsRadius", 4.0f);
	Mesh.bKeepOnCpu = Play.Bool(true);
	ERTMeshHandle Added = ERTMeshHandle::None;
	const FRTStatus Status = Play.GetRenderer().AddMesh(Mesh, Play.Pointer("Out", &Added));
	if (Status) { Play.Assets[Added] = {Mesh.Sections != nullptr, Sections[1].bMayBeMasked, bDeformable}; }
	// Rows of objects give two materials.
	if (Mesh.Sections != nullptr) { Play.Keep(To, Added); }
	return Status;
}

FRTStatus AddMesh(FModulePlay& Play) { return AddAnyMesh(Play, false, Play.Meshes); }
FRTStatus AddDeformableMesh(FModulePlay& Play) { return AddAnyMesh(Play, true, Play.Deformables); }

FRTStatus UpdateMeshVertices(FModulePlay& Play)
{
	const ERTMeshHandle Handle = Play.Handle("mesh", Play.Deformables);
	const float* const NewPositions = Play.Floats("osition", Positions, false);
	return Play.GetRenderer().UpdateMeshVertices(Handle, NewPositions, Play.Floats("normal", Normals, true));
}

FRTStatus GetMeshBuffer(FModulePlay& Play)
{
	const ERTMeshHandle Handle = Play.Handle("mesh", Play.Deformables);
	FRTModuleMeshBuffer Buffer;
	return Play.GetRenderer().GetMeshBuffer(Handle, Play.Pointer("Out", &Buffer));
}

FRTStatus MarkMeshDeformed(FModulePlay& Play) { return Play.GetRenderer().MarkMeshDeformed(Play.Handle("mesh", Play.Deformables)); }

FRTStatus RemoveMesh(FModulePlay& Play)
{
	const uint8_t Kind = Play.Choose() % 4;
	TPlayHandles<ERTMeshHandle>& Of = Kind == 1 ? Play.Deformables : Kind == 2 ? Play.Landscapes : Play.Meshes;
	const ERTMeshHandle Handle = Play.Handle("mesh", Of);
	const FRTStatus Status = Play.GetRenderer().RemoveMesh(Handle);
	if (Status) { Play.Forget(Of, Handle); }
	return Status;
}

void FillTransform(FModulePlay& Play, double Out[12])
{
	constexpr float Good[12] = {1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0};
	for (int Index = 0; Index < 12; ++Index) { Out[Index] = Play.Double("transform", Good[Index]); }
}

FRTStatus AddObject(FModulePlay& Play)
{
	FRTModuleObject Object;
	uint32_t Sections = 0;
	Object.Mesh = Play.Handle("mesh", Play.AnyMeshes(Sections));
	ERTMaterialHandle Materials[2] = {};
	for (uint32_t Section = 0; Section < Sections; ++Section) { Materials[Section] = Play.Handle("material", Play.Materials); }
	Object.Materials = Play.Pointer("materials", Materials);
	Object.MaterialCount = Play.Count("materials", Sections);
	FillTransform(Play, Object.Transform);
	Object.bCastsShadow = Play.Bool(true);
	Object.Mobility = Play.Bool(true) ? ERTModuleMobility::Movable : static_cast<ERTModuleMobility>(Play.Index("Mobility", 0));
	ERTObjectHandle Added = ERTObjectHandle::None;
	const FRTStatus Status = Play.GetRenderer().AddObject(Object, Play.Pointer("Out", &Added));
	Play.Keep(Play.Objects, Added);
	return Status;
}

FRTStatus SetObjectTransform(FModulePlay& Play)
{
	double Transform[12];
	FillTransform(Play, Transform);
	const ERTObjectHandle Handle = Play.Handle("object", Play.Objects);
	return Play.GetRenderer().SetObjectTransform(Handle, Play.Pointer("transform", Transform));
}

FRTStatus SetObjectMaterials(FModulePlay& Play)
{
	const ERTMaterialHandle Materials[] = {Play.Handle("material", Play.Materials), Play.Handle("material", Play.Materials)};
	const ERTObjectHandle Handle = Play.Handle("object", Play.Objects);
	const ERTMaterialHandle* const Given = Play.Pointer("materials", Materials);
	return Play.GetRenderer().SetObjectMaterials(Handle, Given, Play.Count("materials", 2));
}

FRTStatus SetObjectCastsShadow(FModulePlay& Play)
{
	const ERTObjectHandle Handle = Play.Handle("object", Play.Objects);
	return Play.GetRenderer().SetObjectCastsShadow(Handle, Play.Bool(true));
}

FRTStatus SetObjectVisible(FModulePlay& Play)
{
	const ERTObjectHandle Handle = Play.Handle("object", Play.Objects);
	return Play.GetRenderer().SetObjectVisible(Handle, Play.Bool(true));
}

FRTStatus AddObjects(FModulePlay& Play)
{
	const ERTMaterialHandle Materials[] = {Play.Handle("material", Play.Materials), Play.Handle("material", Play.Materials)};
	FRTModuleObject Objects[2];
	for (FRTModuleObject& Object : Objects)
	{
		Object.Mesh = Play.Handle("mesh", Play.Meshes);
		Object.Materials = Play.Pointer("materials", Materials);
		Object.MaterialCount = Play.Count("materials", 2);
		FillTransform(Play, Object.Transform);
	}
	ERTObjectHandle Added[2] = {};
	const FRTModuleObject* const Given = Play.Pointer("Objects", Objects);
	const FRTStatus Status = Play.GetRenderer().AddObjects(Given, 2, Play.Pointer("Out", Added));
	for (const ERTObjectHandle Handle : Added) { Play.Keep(Play.Objects, Handle); }
	return Status;
}

FRTModuleLight MakeLight(FModulePlay& Play)
{
	FRTModuleLight Light;
	constexpr ERTModuleLight Types[] = {ERTModuleLight::Spot, ERTModuleLight::Point, ERTModuleLight::Directional, ERTModuleLight::Rectangle,
	    ERTModuleLight::Disk, ERTModuleLight::Sphere, ERTModuleLight::Tube};
	Light.Type = Types[Play.Choose() % std::size(Types)];
	if (Light.Type != ERTModuleLight::Directional)
	{
		for (double& Axis : Light.Position) { Axis = Play.Double("Position", 2.0); }
	}
	if (Light.Type == ERTModuleLight::Spot)
	{
		for (int Axis = 0; Axis < 3; ++Axis) { Light.Direction[Axis] = Play.Float("Direction", Axis == 1 ? -1.0f : 0.0f); }
		Light.InnerCone = Play.Float("InnerCone", 0.1f);
		Light.OuterCone = Play.Float("OuterCone", 0.5f);
	}
	if (Light.Type == ERTModuleLight::Rectangle)
	{
		for (int Axis = 0; Axis < 3; ++Axis) { Light.Tangent[Axis] = Play.Float("Tangent", Axis == 0 ? 1.0f : 0.0f); }
		Light.Width = Play.Float("Width", 0.5f);
		Light.Height = Play.Float("Height", 0.25f);
	}
	else if (Light.Type > ERTModuleLight::Rectangle) { Light.Radius = Play.Float("Radius", 0.1f); }
	if (Light.Type == ERTModuleLight::Tube) { Light.Length = Play.Float("Length", 1.0f); }
	for (float& Channel : Light.Color) { Channel = Play.Float("Color", 3.0f); }
	Light.Range = Play.Float("Range", 0.0f);
	return Light;
}

FRTStatus AddLight(FModulePlay& Play)
{
	ERTLightHandle Added = ERTLightHandle::None;
	const FRTModuleLight Light = MakeLight(Play);
	const FRTStatus Status = Play.GetRenderer().AddLight(Light, Play.Pointer("Out", &Added));
	Play.Keep(Play.Lights, Added);
	return Status;
}

FRTStatus SetLight(FModulePlay& Play)
{
	const ERTLightHandle Handle = Play.Handle("light", Play.Lights);
	return Play.GetRenderer().SetLight(Handle, MakeLight(Play));
}

FRTStatus RemoveLight(FModulePlay& Play)
{
	const ERTLightHandle Handle = Play.Handle("light", Play.Lights);
	const FRTStatus Status = Play.GetRenderer().RemoveLight(Handle);
	if (Status) { Play.Forget(Play.Lights, Handle); }
	return Status;
}

FRTStatus RemoveObject(FModulePlay& Play)
{
	const ERTObjectHandle Handle = Play.Handle("object", Play.Objects);
	const FRTStatus Status = Play.GetRenderer().RemoveObject(Handle);
	if (Status) { Play.Forget(Play.Objects, Handle); }
	return Status;
}

FRTStatus SetSun(FModulePlay& Play)
{
	FRTModuleSun Sun;
	for (int Axis = 0; Axis < 3; ++Axis) { Sun.Direction[Axis] = Play.Double("Direction", Axis == 1 ? -1.0 : 0.0); }
	for (float& Channel : Sun.Color) { Channel = Play.Float("Color", 1.0f); }
	Sun.Irradiance = Play.Float("Irradiance", 1.0f);
	Sun.AngularDiameter = Play.Float("AngularDiameter", 0.01f);
	return Play.GetRenderer().SetSun(Sun);
}

FRTStatus SetSky(FModulePlay& Play)
{
	float Radiance[3];
	for (float& Channel : Radiance) { Channel = Play.Float("radiance", 1.0f); }
	return Play.GetRenderer().SetSky(Play.Pointer("radiance", Radiance));
}

FRTModuleView MakeView(FModulePlay& Play)
{
	FRTModuleView View;
	for (double& Axis : View.Position) { Axis = Play.Double("Position", 1.0); }
	for (int Axis = 0; Axis < 3; ++Axis)
	{
		View.Forward[Axis] = Play.Float("Forward", Axis == 2 ? -1.0f : 0.0f);
		View.Up[Axis] = Play.Float("Up", Axis == 1 ? 1.0f : 0.0f);
	}
	View.Projection = MakeProjection(1.0f, 1.0f, 0.1f);
	for (float& Element : View.Projection.ViewToClip) { Element = Play.Float("Projection", Element); }
	for (float& Axis : View.Jitter) { Axis = Play.Float("Jitter", 0.25f); }
	return View;
}

void MakeLayout(FModulePlay& Play, FRTModuleGBufferLayout& Out)
{
	Out.Depth = static_cast<ERTModuleDepth>(Play.Index("Depth", 0));
	Out.Normals = static_cast<ERTModuleNormals>(Play.Index("Normals", 0));
	Out.NormalRange = static_cast<ERTModuleRange>(Play.Index("NormalRange", 0));
	Out.Motion = static_cast<ERTModuleMotion>(Play.Index("Motion", 0));
	Out.Material = static_cast<ERTModuleMaterialLayout>(Play.Index("Material", 0));
	Out.MotionScale[0] = Play.Float("MotionScale", 1.0f);
}

/// What all calls that take a frame read of it. bMayLack: depth and normals may be null, and nothing else is read then.
FRTModuleFrame MakeFrame(FModulePlay& Play, bool bMayLack)
{
	FRTModuleFrame Frame;
	Frame.View = MakeView(Play);
	Frame.Depth = Play.Texture("epth", ERTFormat::D32_FLOAT, bMayLack);
	Frame.Normals = Play.Texture("ormals", ERTFormat::RGBA16_SNORM, bMayLack, {ERTFormat::RGBA32_FLOAT, ERTFormat::RGBA8_UNORM});
	Frame.GeometricNormals = Play.Texture("ormals", ERTFormat::RGBA16_SNORM, true, {ERTFormat::RGBA32_FLOAT, ERTFormat::RGBA8_UNORM});
	Frame.Motion = Play.Texture("otion", ERTFormat::RGBA32_FLOAT, true);
	Frame.BaseColor = Play.Texture("base colour", ERTFormat::RGBA8_SRGB, true);
	Frame.Material = Play.Texture("aterial", ERTFormat::RGBA8_UNORM, true);
	Frame.OffsetX = Play.Index("OffsetX", 0);
	Frame.OffsetY = Play.Index("OffsetY", 0);
	Frame.Width = Play.Index("Width", 0);
	Frame.Height = Play.Index("Height", 0);
	if (bMayLack && (Frame.Depth == nullptr || Frame.Normals == nullptr)) { Play.ExpectNothing(); }
	MakeLayout(Play, Frame.Layout);
	if (Play.Bool(true)) { Frame.Wanted.Add(ESignal::AmbientOcclusion); }
	Frame.bFog = Play.Bool(false);
	Frame.bIndirectVolume = Play.Bool(false);
	Frame.bLightMask = Play.Bool(false);
	return Frame;
}

FRTStatus RenderFrame(FModulePlay& Play)
{
	FRTModuleFrame Frame = MakeFrame(Play, false);
	Frame.Commands = Play.Pointer("Commands", Play.MakeList());
	Frame.ViewIndex = Play.Choose() % 3;
	Frame.DeltaSeconds = Play.Float("DeltaSeconds", 0.016f);
	Frame.Exposure = Play.Float("Exposure", 0.25f);
	Frame.bCut = Play.Bool(false);
	Frame.bSubmitAhead = Play.Bool(false);
	Frame.DepthAccess = Play.Number("DepthAccess", 1, 0) == 0 ? ERTAccess::None : ERTAccess::ShaderRead;
	FRTModuleView Previous;
	if (Play.Bool(false)) { Frame.PreviousView = &(Previous = MakeView(Play)); }
	FRTModuleOutputs Outputs;
	return Play.GetRenderer().RenderFrame(Frame, Play.Pointer("Out", &Outputs));
}

FRTStatus Precache(FModulePlay& Play)
{
	const FRTModuleProgress Progress = [](void*, float) {};
	const FRTModuleFrame Frame = MakeFrame(Play, true);
	return Play.GetRenderer().Precache(Frame, Play.Bool(true) ? Progress : nullptr, nullptr);
}

FRTStatus EndFrame(FModulePlay& Play)
{
	FRTFence Fence = 0;
	return Play.GetRenderer().EndFrame(Play.Bool(true) ? &Fence : nullptr);
}

bool GiveAgain(void* User, ERTMeshHandle Handle, FRTModuleMesh* Out)
{
	static constexpr uint32_t Indices[] = {0, 1, 2, 2, 1, 3};
	static constexpr FRTModuleSection Sections[2][2] = {{{0, 3, true}, {3, 3, false}}, {{0, 3, true}, {3, 3, true}}};
	const auto& Play = *static_cast<const FModulePlay*>(User);
	const FModulePlay::FAsset& Asset = Play.Assets.at(Handle);
	Out->Name = "Again";
	Out->Positions = Positions;
	Out->VertexCount = 4;
	Out->Indices = Indices;
	Out->IndexCount = 6;
	Out->Sections = Asset.bSections ? Sections[Asset.bMayBeMasked ? 1 : 0] : nullptr;
	Out->SectionCount = Asset.bSections ? 2 : 0;
	Out->bDeformable = Asset.bDeformable;
	return true;
}

/// To the device that it has: what stands on it is made anew.
FRTStatus Recreate(FModulePlay& Play)
{
	FRTModuleMeshSource Source{GiveAgain, &Play};
	if (!Play.Bool(true)) { Source.Get = nullptr; }
	return Play.GetRenderer().Recreate(Play.Pointer("Device", Play.GetDevice()), Source);
}

FRTStatus SetConsoleVariable(FModulePlay& Play)
{
	constexpr const char* Names[] = {"r.RT.Shadow.Path", "r.RT.AO.Path", "r.RT.Shadow", "r.RT.Culling", "r.RT.Scene.Gather",
	    "r.RT.SBT.Mode", "r.RT.Build.TrianglesPerFrame", "r.RT.Build.Compaction", "r.RT.Shadow.Soft", "r.RT.AlphaTest", "r.RT.GI",
	    "r.RT.Reflections", "r.RT.Scene.ArrivalsPerFrame", "r.RT.Upload.MBPerFrame", "r.RT.Upload.TransferQueue",
	    "r.RT.FrameGraph.KeepFrames", "r.RT.FrameGraph.Tasks", "r.RT.Build.MemoryMB", "r.RT.Build.CoarserLevels", "r.RT.Opacity.Pieces",
	    "r.RT.SkyAmbient", "r.RT.Enable", "r.RT.Reorder"};
	constexpr const char* Values[] = {"1", "0", "2"};
	const char* const Name = Play.Pointer("Name", Names[Play.Choose() % std::size(Names)]);
	return Play.GetModule().SetConsoleVariable(Name, Play.Pointer("Value", Values[Play.Choose() % std::size(Values)]));
}

FRTStatus GetConsoleVariable(FModulePlay& Play)
{
	char Text[4];
	const char* const Name = Play.Pointer("Name", "r.RT.Shadow");
	return Play.GetModule().GetConsoleVariable(Name, Play.Pointer("Out", Text), Play.Bool(true) ? sizeof(Text) : 1);
}

constexpr FModuleCall Calls[] = {
    {"RenderFrame", RenderFrame},
    {"EndFrame", EndFrame, 0},
    {"AddMaterial", AddMaterial},
    {"SetMaterial", SetMaterial},
    {"RemoveMaterial", RemoveMaterial},
    {"AddMesh", AddMesh},
    {"AddDeformableMesh", AddDeformableMesh},
    {"UpdateMeshVertices", UpdateMeshVertices},
    {"GetMeshBuffer", GetMeshBuffer},
    {"MarkMeshDeformed", MarkMeshDeformed},
    {"RemoveMesh", RemoveMesh},
    {"AddObject", AddObject},
    {"AddObjects", AddObjects},
    {"SetObjectTransform", SetObjectTransform},
    {"SetObjectMaterials", SetObjectMaterials},
    {"SetObjectCastsShadow", SetObjectCastsShadow},
    {"SetObjectVisible", SetObjectVisible},
    {"RemoveObject", RemoveObject},
    {"AddLight", AddLight},
    {"SetLight", SetLight},
    {"RemoveLight", RemoveLight},
    {"SetSun", SetSun},
    {"SetSky", SetSky},
    {"Recreate", Recreate},
    {"SetConsoleVariable", SetConsoleVariable},
    {"GetConsoleVariable", GetConsoleVariable},
    {"AddStreamedMesh", AddStreamedMesh},
    {"AddLandscape", AddLandscape},
    {"SetLandscapeHeights", SetLandscapeHeights},
    {"SetObjectMesh", SetObjectMesh},
    {"SetSkyMap", SetSkyMap},
    {"SetSkyProgram", SetSkyProgram},
    {"Precache", Precache},
};

} // namespace

std::span<const FModuleCall> GetModuleCalls() { return Calls; }

} // namespace Lantern

// Calls of a play that hand over buffers, heights and a sky.
#include "ModuleCallsAssets.h"

#include <array>

namespace Lantern
{

namespace
{

/// Format: one that fits.
FRTModuleStream MakeStream(FModulePlay& Play, const char* Name, uint64_t Offset, ERTModuleVertex Format, bool bMayBeNull)
{
	FRTModuleStream Stream;
	Stream.Buffer = Play.Buffer(Name, bMayBeNull);
	if (Stream.Buffer == nullptr) { return Stream; } // nothing else of it is looked at
	Stream.Offset = Play.Index(Name, static_cast<uint32_t>(Offset));
	Stream.Stride = Play.Index(Name, 48);
	Stream.Format = static_cast<ERTModuleVertex>(Play.Index(Name, static_cast<uint32_t>(Format)));
	return Stream;
}

} // namespace

FRTStatus AddStreamedMesh(FModulePlay& Play)
{
	FRTModuleStreams Streams;
	Streams.Positions = MakeStream(Play, "Positions", 0, ERTModuleVertex::Float3, false);
	Streams.Normals = MakeStream(Play, "Normals", 12, ERTModuleVertex::Snorm8x4, true);
	Streams.Tangents = MakeStream(Play, "Tangents", 16, ERTModuleVertex::Half4, true);
	Streams.UVs = MakeStream(Play, "UVs", 24, ERTModuleVertex::Half2, true);
	Streams.UVs1 = MakeStream(Play, "UVs1", 28, ERTModuleVertex::Float2, true);
	Streams.Colors = MakeStream(Play, "Colors", 36, ERTModuleVertex::Bgra8, true);
	Streams.Indices = Play.Buffer("Indices", false);
	Streams.bIndices16 = Play.Bool(false);
	Streams.bSignInNormals = Play.Bool(false);
	Streams.IndicesOffset = Play.Index("IndicesOffset", 512);
	std::array<FRTModuleSection, 2> Sections = {FRTModuleSection{0, 3, true, 0}, FRTModuleSection{3, 3, true, 1}};
	Sections[1].FirstVertex = Play.Index("FirstVertex", 1);
	Sections[0].IndexCount = Play.Count("section", 3);
	FRTModuleMesh Mesh;
	Mesh.Name = Play.Pointer("Name", "Streamed");
	Mesh.VertexCount = Play.Count("VertexCount", 4);
	Mesh.IndexCount = Play.Count("IndexCount", 6);
	Mesh.Sections = Sections.data();
	Mesh.SectionCount = Play.Count("section", 2);
	for (float& Axis : Mesh.BoundsCenter) { Axis = Play.Float("BoundsCenter", 0.0f); }
	Mesh.BoundsRadius = Play.Float("BoundsRadius", 4.0f);
	Mesh.Streams = &Streams;
	ERTMeshHandle Added = ERTMeshHandle::None;
	const FRTStatus Status = Play.GetRenderer().AddMesh(Mesh, Play.Pointer("Out", &Added));
	if (Status) { Play.Assets[Added] = {true, true, false}; }
	Play.Keep(Play.Meshes, Added);
	return Status;
}

FRTStatus AddLandscape(FModulePlay& Play)
{
	static constexpr uint16_t Heights[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14};
	static constexpr uint8_t Holes[] = {0, 1, 0, 0, 0, 0, 0, 0};
	FRTModuleLandscape Patch;
	Patch.Name = Play.Pointer("Name", "Patch");
	Patch.Heights = Play.Pointer("Heights", Heights);
	Patch.Columns = Play.Count("Columns", 4);
	Patch.Rows = Play.Count("Rows", 3);
	Patch.SpacingX = Play.Float("SpacingX", 1.0f);
	Patch.SpacingY = Play.Float("SpacingY", 2.0f);
	Patch.HeightScale = Play.Float("HeightScale", 0.5f);
	Patch.HeightOffset = Play.Float("HeightOffset", -1.0f);
	Patch.Holes = Play.Bool(true) ? Holes : nullptr;
	Patch.RowPitch = Play.Number("RowPitch", 5, 3);
	Patch.HolesPitch = Play.Number("HolesPitch", 4, 2);
	ERTMeshHandle Added = ERTMeshHandle::None;
	const FRTStatus Status = Play.GetRenderer().AddLandscape(Patch, Play.Pointer("Out", &Added));
	Play.Keep(Play.Landscapes, Added);
	return Status;
}

FRTStatus SetLandscapeHeights(FModulePlay& Play)
{
	static constexpr uint16_t Heights[] = {100, 200, 300, 400, 500, 600};
	const ERTMeshHandle Handle = Play.Handle("mesh", Play.Landscapes);
	FRTModuleHeights New;
	New.Heights = Play.Pointer("Heights", Heights);
	New.FirstColumn = Play.Index("FirstColumn", 2);
	New.FirstRow = Play.Index("FirstRow", 1);
	New.Columns = Play.Count("Columns", 2);
	New.Rows = Play.Count("Rows", 2);
	New.RowPitch = Play.Number("RowPitch", 3, 1);
	return Play.GetRenderer().SetLandscapeHeights(Handle, New);
}

FRTStatus SetObjectMesh(FModulePlay& Play)
{
	const ERTObjectHandle Handle = Play.Handle("object", Play.Objects);
	uint32_t Sections = 0;
	const ERTMeshHandle Mesh = Play.Handle("mesh", Play.AnyMeshes(Sections));
	ERTMaterialHandle Materials[2] = {};
	for (uint32_t Section = 0; Section < Sections; ++Section) { Materials[Section] = Play.Handle("material", Play.Materials); }
	const ERTMaterialHandle* const Given = Play.Pointer("materials", Materials);
	return Play.GetRenderer().SetObjectMesh(Handle, Mesh, Given, Play.Count("materials", Sections));
}

FRTStatus SetSkyMap(FModulePlay& Play)
{
	if (!Play.Bool(true)) { return Play.GetRenderer().SetSkyMap(nullptr); }
	FRTModuleSkyMap Map;
	Map.Texture = Play.Pointer("Texture", Play.GetSky());
	Map.Sampler = Play.Pointer("Sampler", Play.GetSampler());
	Map.Kind = static_cast<ERTModuleSkyMap>(Play.Index("Kind", 0));
	Map.Intensity = Play.Float("Intensity", 2.0f);
	for (float& Element : Map.WorldToMap) { Element = Play.Float("WorldToMap", Element); }
	return Play.GetRenderer().SetSkyMap(&Map);
}

FRTStatus SetSkyProgram(FModulePlay& Play)
{
	if (!Play.Bool(true)) { return Play.GetRenderer().SetSkyProgram(nullptr); }
	FRTModuleSkyProgram Program;
	Program.Seconds = Play.Double("Seconds", 3.0);
	for (float& Value : Program.Values) { Value = Play.Float("Values", 0.5f); }
	return Play.GetRenderer().SetSkyProgram(&Program);
}

} // namespace Lantern

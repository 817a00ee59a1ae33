// Triangle lists from lists, strips and fans.
#include "Gltf/GltfTriangles.h"

#include <fmt/format.h>

namespace Lantern::Gltf
{

namespace
{

constexpr uint64_t ModeTriangles = 4, ModeStrip = 5, ModeFan = 6;

/// Triangle strips and fans as lists, in the winding of the specification (glTF 2.0 §3.7.2.1).
std::vector<uint32_t> ToList(uint64_t Mode, std::vector<uint32_t>&& Source)
{
	if (Mode == ModeTriangles)
	{
		Source.resize(Source.size() / 3 * 3);
		return std::move(Source);
	}
	std::vector<uint32_t> List;
	for (size_t I = 0; I + 2 < Source.size(); ++I)
	{
		if (Mode == ModeStrip) { List.insert(List.end(), {Source[I], Source[I + 1 + I % 2], Source[I + 2 - I % 2]}); }
		else { List.insert(List.end(), {Source[I + 1], Source[I + 2], Source[0]}); }
	}
	return List;
}

} // namespace

bool ReadTriangles(FDocument& Document, const FJson& Json, uint64_t VertexCount, std::vector<uint32_t>& OutIndices)
{
	const uint64_t Mode = Json.GetUInt("mode", ModeTriangles, ModeFan);
	if (Mode < ModeTriangles)
	{
		Document.Warn("points and lines are not rendered");
		return false;
	}
	std::vector<uint32_t> Source;
	const int32_t IndexAccessor = Json.GetIndex("indices", Document.Accessors.size(), "accessor");
	if (IndexAccessor >= 0)
	{
		const FAccessor& Accessor = Document.Accessors[size_t(IndexAccessor)];
		const FJson Place = Json.Member("indices");
		const EComponent Type = Accessor.Elements.Type;
		if (Accessor.Components != 1 || (Type != EComponent::U8 && Type != EComponent::U16 && Type != EComponent::U32))
		{
			Place.Fail("indices must be unsigned scalars");
		}
		Document.ChargeGeometry(Place, Accessor.Count, Mode == ModeTriangles ? 4 : 16);
		Source = ReadIndices(Accessor);
		for (size_t I = 0; I < Source.size(); ++I)
		{
			if (Source[I] >= VertexCount)
			{
				Json.Fail(fmt::format("index {} is {}, but there are {} vertices", I, Source[I], VertexCount));
			}
		}
	}
	else
	{
		Document.ChargeGeometry(Json, VertexCount, Mode == ModeTriangles ? 4 : 16);
		Source.resize(VertexCount);
		for (size_t I = 0; I < Source.size(); ++I) { Source[I] = uint32_t(I); }
	}
	if (Mode == ModeTriangles && Source.size() % 3 != 0)
	{
		Document.Warn(fmt::format("{}: {} indices are no whole triangles; the rest is left out", Json.GetPath(), Source.size()));
	}
	OutIndices = ToList(Mode, std::move(Source));
	return true;
}

} // namespace Lantern::Gltf

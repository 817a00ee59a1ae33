// Buffers, buffer views and accessors: bounds first, then bytes.
#include <cstring>

#include <fmt/format.h>

#include "Gltf/GltfDocument.h"
#include "LanternCore/Text/Quote.h"

namespace Lantern::Gltf
{

void FDocument::ChargeGeometry(const FJson& Place, uint64_t Count, uint64_t BytesEach)
{
	const uint64_t Left = Options.MaxGeometryBytes - GeometryBytes;
	if (Count > Left / BytesEach)
	{
		Place.Fail(fmt::format("geometry unfolds to more than the limit of {} bytes", Options.MaxGeometryBytes));
	}
	GeometryBytes += Count * BytesEach;
}

namespace
{

uint32_t GetComponentBytes(EComponent Type)
{
	switch (Type)
	{
	case EComponent::I8:
	case EComponent::U8: return 1;
	case EComponent::I16:
	case EComponent::U16: return 2;
	case EComponent::U32:
	case EComponent::F32: return 4;
	}
	return 0;
}

EComponent ReadComponentType(const FJson& Json)
{
	const FJson Type = Json.Member("componentType");
	if (!Type.Exists()) { Json.Fail("'componentType' is missing"); }
	const auto Value = EComponent(Type.ToUInt(UINT32_MAX));
	if (GetComponentBytes(Value) == 0) { Type.Fail(fmt::format("{} is no component type", uint32_t(Value))); }
	return Value;
}

uint32_t ReadComponentCount(const FJson& Json)
{
	const FJson Type = Json.Member("type");
	if (!Type.Exists()) { Json.Fail("'type' is missing"); }
	const std::string& Name = Type.ToString();
	constexpr std::pair<const char*, uint32_t> Types[] = {
	    {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
	for (const auto& [Candidate, Count] : Types)
	{
		if (Name == Candidate) { return Count; }
	}
	Type.Fail(fmt::format("{} is no accessor type", Quote(Name)));
}

/// Checks that Count elements fit, without an overflow for any numbers.
FElements MakeElements(
    const FDocument& Document, const FJson& Json, EComponent Type, uint32_t ElementBytes, uint64_t Count, bool bMayBeStrided)
{
	const int32_t View = Json.GetIndex("bufferView", Document.BufferViews.size(), "buffer view");
	if (View < 0) { return {nullptr, 0, Type}; }
	const FBytes Bytes = Document.BufferViews[View];
	const uint64_t Offset = Json.GetUInt("byteOffset", 0);
	const uint64_t DeclaredStride = bMayBeStrided ? Document.BufferViewStrides[View] : 0;
	const uint64_t Stride = DeclaredStride != 0 ? DeclaredStride : ElementBytes;
	if (Stride < ElementBytes)
	{
		Json.Fail(fmt::format("stride {} of buffer view {} is less than an element's {} bytes", Stride, View, ElementBytes));
	}
	const uint64_t Available = Offset <= Bytes.size() ? Bytes.size() - Offset : 0;
	const uint64_t Fits = Available >= ElementBytes ? (Available - ElementBytes) / Stride + 1 : 0;
	if (Count > Fits)
	{
		Json.Fail(fmt::format("{} elements of {} bytes from byte {} do not fit buffer view {}, which has {} bytes", Count, Stride, Offset,
		    View, Bytes.size()));
	}
	return {Bytes.data() + Offset, size_t(Stride), Type};
}

void ReadSparse(const FDocument& Document, const FJson& Json, uint32_t ElementBytes, FAccessor& OutAccessor)
{
	const FJson Sparse = Json.Member("sparse");
	if (!Sparse.Exists()) { return; }
	OutAccessor.SparseCount = Sparse.GetUInt("count", 0, OutAccessor.Count);
	const FJson Indices = Sparse.Member("indices");
	const FJson Values = Sparse.Member("values");
	if (!Indices.Member("bufferView").Exists() || !Values.Member("bufferView").Exists())
	{
		Sparse.Fail("'indices.bufferView' or 'values.bufferView' is missing");
	}
	const EComponent IndexType = ReadComponentType(Indices);
	if (IndexType != EComponent::U8 && IndexType != EComponent::U16 && IndexType != EComponent::U32)
	{
		Indices.Fail("sparse indices must be unsigned integers");
	}
	OutAccessor.SparseIndices = MakeElements(Document, Indices, IndexType, GetComponentBytes(IndexType), OutAccessor.SparseCount, false);
	OutAccessor.SparseValues = MakeElements(Document, Values, OutAccessor.Elements.Type, ElementBytes, OutAccessor.SparseCount, false);
}

/// Throws where a sparse index is out of range, so that readers need not look.
void CheckSparse(const FJson& Json, const FAccessor& Accessor)
{
	for (uint64_t I = 0; I < Accessor.SparseCount; ++I)
	{
		uint32_t Index = 0;
		std::memcpy(&Index, Accessor.SparseIndices.Data + I * Accessor.SparseIndices.Stride, Accessor.SparseIndices.Stride);
		if (Index >= Accessor.Count)
		{
			Json.Fail(fmt::format("sparse index {} is {}, but there are {} elements", I, Index, Accessor.Count));
		}
	}
}

float Convert(EComponent Type, const uint8_t* Data, bool bNormalized)
{
	switch (Type)
	{
	case EComponent::I8:
	{
		const float V = float(int8_t(*Data));
		return bNormalized ? std::max(V / 127.0f, -1.0f) : V;
	}
	case EComponent::U8: return bNormalized ? float(*Data) / 255.0f : float(*Data);
	case EComponent::I16:
	{
		int16_t V;
		std::memcpy(&V, Data, 2);
		return bNormalized ? std::max(float(V) / 32767.0f, -1.0f) : float(V);
	}
	case EComponent::U16:
	{
		uint16_t V;
		std::memcpy(&V, Data, 2);
		return bNormalized ? float(V) / 65535.0f : float(V);
	}
	case EComponent::U32:
	{
		uint32_t V;
		std::memcpy(&V, Data, 4);
		return float(V);
	}
	case EComponent::F32: break;
	}
	float V;
	std::memcpy(&V, Data, 4);
	return V;
}

uint32_t ReadUInt(const FElements& Elements, uint64_t Index, uint32_t Component)
{
	const uint32_t Bytes = GetComponentBytes(Elements.Type);
	uint32_t Value = 0;
	std::memcpy(&Value, Elements.Data + Index * Elements.Stride + Component * Bytes, Bytes);
	return Value;
}

/// Calls Write(destination, source) for each element that the file gives.
template <class T>
void ForEachElement(const FAccessor& Accessor, const T& Write)
{
	if (Accessor.Elements.Data != nullptr)
	{
		for (uint64_t I = 0; I < Accessor.Count; ++I) { Write(I, Accessor.Elements.Data + I * Accessor.Elements.Stride); }
	}
	for (uint64_t I = 0; I < Accessor.SparseCount; ++I)
	{
		Write(ReadUInt(Accessor.SparseIndices, I, 0), Accessor.SparseValues.Data + I * Accessor.SparseValues.Stride);
	}
}

template <class TVector>
std::vector<TVector> ReadFloats(const FAccessor& Accessor, const TVector& Fill)
{
	constexpr uint32_t Size = uint32_t(sizeof(TVector) / sizeof(float));
	const uint32_t Components = std::min(Accessor.Components, Size);
	std::vector<TVector> Result(Accessor.Count, Fill);
	const FElements& Source = Accessor.Elements;
	if (Source.Type == EComponent::F32 && Source.Data != nullptr && Accessor.SparseCount == 0 && Accessor.Components == Size &&
	    Source.Stride == sizeof(TVector))
	{
		std::memcpy(static_cast<void*>(Result.data()), Source.Data, Result.size() * sizeof(TVector));
		return Result;
	}
	const uint32_t Bytes = GetComponentBytes(Source.Type);
	if (Source.Data == nullptr)
	{
		for (TVector& Element : Result) { std::memset(static_cast<void*>(&Element), 0, Components * sizeof(float)); }
	}
	ForEachElement(Accessor, [&](uint64_t I, const uint8_t* Data) {
		float Values[Size];
		for (uint32_t C = 0; C < Components; ++C) { Values[C] = Convert(Source.Type, Data + C * Bytes, Accessor.bNormalized); }
		std::memcpy(static_cast<void*>(&Result[I]), Values, Components * sizeof(float));
	});
	return Result;
}

} // namespace

std::vector<glm::vec4> ReadVec4(const FAccessor& Accessor, const glm::vec4& Fill) { return ReadFloats<glm::vec4>(Accessor, Fill); }
std::vector<glm::vec3> ReadVec3(const FAccessor& Accessor) { return ReadFloats<glm::vec3>(Accessor, glm::vec3(0)); }
std::vector<glm::vec2> ReadVec2(const FAccessor& Accessor) { return ReadFloats<glm::vec2>(Accessor, glm::vec2(0)); }
std::vector<float> ReadScalars(const FAccessor& Accessor) { return ReadFloats<float>(Accessor, 0.0f); }
std::vector<glm::mat4> ReadMat4(const FAccessor& Accessor) { return ReadFloats<glm::mat4>(Accessor, glm::mat4(1)); }

std::vector<glm::uvec4> ReadUVec4(const FAccessor& Accessor)
{
	std::vector<glm::uvec4> Result(Accessor.Count, glm::uvec4(0));
	const FElements Source = Accessor.Elements;
	ForEachElement(Accessor, [&](uint64_t I, const uint8_t* Data) {
		for (uint32_t C = 0; C < std::min(Accessor.Components, 4u); ++C) { Result[I][int(C)] = ReadUInt({Data, 0, Source.Type}, 0, C); }
	});
	return Result;
}

std::vector<uint32_t> ReadIndices(const FAccessor& Accessor)
{
	std::vector<uint32_t> Result(Accessor.Count, 0);
	const EComponent Type = Accessor.Elements.Type;
	ForEachElement(Accessor, [&](uint64_t I, const uint8_t* Data) { Result[I] = ReadUInt({Data, 0, Type}, 0, 0); });
	return Result;
}

namespace
{

FBlob ReadBuffer(const FDocument& Document, const FJson& Json, size_t Index)
{
	const FJson Length = Json.Member("byteLength");
	if (!Length.Exists()) { Json.Fail("'byteLength' is missing"); }
	const uint64_t ByteLength = Length.ToUInt(UINT64_MAX);
	FBlob Blob;
	const FJson Uri = Json.Member("uri");
	if (!Uri.Exists())
	{
		if (Index != 0 || Document.GlbBinary.empty()) { Json.Fail("neither a 'uri' nor a binary chunk"); }
		Blob.Bytes = Document.GlbBinary;
	}
	else if (IsDataUri(Uri.ToString())) { Blob.Own(DecodeDataUri(Uri, Uri.ToString())); }
	else
	{
		const std::filesystem::path Path = ResolveUri(Uri, Uri.ToString(), Document.Folder);
		try
		{
			Blob.Own(ReadFile(Path, uint64_t(1) << 40));
		}
		catch (const FError& Error)
		{
			Json.Fail(fmt::format("'{}' {}", EscapePath(Path.string()), Error.what()));
		}
	}
	if (Blob.Bytes.size() < ByteLength)
	{
		Json.Fail(fmt::format("ends early: {} bytes declared, {} there", ByteLength, Blob.Bytes.size()));
	}
	Blob.Bytes = Blob.Bytes.first(ByteLength);
	return Blob;
}

} // namespace

void ReadBuffers(FDocument& Document)
{
	const FJson Buffers = Document.Root.Member("buffers");
	for (size_t I = 0; I < Buffers.Count(); ++I)
	{
		const FJson Json = Buffers.Element(I);
		Document.Buffers.push_back(ReadBuffer(Document, Json, I));
	}
	const FJson Views = Document.Root.Member("bufferViews");
	for (size_t I = 0; I < Views.Count(); ++I)
	{
		const FJson Json = Views.Element(I);
		const int32_t Buffer = Json.RequireIndex("buffer", Document.Buffers.size(), "buffer");
		const FBytes Bytes = Document.Buffers[Buffer].Bytes;
		const uint64_t Offset = Json.GetUInt("byteOffset", 0);
		const uint64_t Length = Json.GetUInt("byteLength", 0);
		if (Offset > Bytes.size() || Length > Bytes.size() - Offset)
		{
			Json.Fail(fmt::format("{} bytes from byte {} do not fit buffer {}, which has {}", Length, Offset, Buffer, Bytes.size()));
		}
		Document.BufferViews.push_back(Bytes.subspan(Offset, Length));
		Document.BufferViewStrides.push_back(uint32_t(Json.GetUInt("byteStride", 0, 252)));
	}
}

void ReadAccessors(FDocument& Document)
{
	const FJson Accessors = Document.Root.Member("accessors");
	for (size_t I = 0; I < Accessors.Count(); ++I)
	{
		const FJson Json = Accessors.Element(I);
		FAccessor Accessor;
		const EComponent Type = ReadComponentType(Json);
		Accessor.Components = ReadComponentCount(Json);
		if (!Json.Member("count").Exists()) { Json.Fail("'count' is missing"); }
		// The limit keeps an accessor without bytes of its own (all zeros) from asking for any amount.
		Accessor.Count = Json.GetUInt("count", 0, Document.Options.MaxGeometryBytes / 4);
		Accessor.bNormalized = Json.GetBool("normalized", false);
		const uint32_t ElementBytes = GetComponentBytes(Type) * Accessor.Components;
		Accessor.Elements = MakeElements(Document, Json, Type, ElementBytes, Accessor.Count, true);
		ReadSparse(Document, Json, ElementBytes, Accessor);
		Document.ChargeGeometry(Json, Accessor.SparseCount, 4);
		CheckSparse(Json, Accessor);
		Document.Accessors.push_back(Accessor);
	}
}

} // namespace Lantern::Gltf

// Meshes in the engine's own buffers: the picture is that of the same mesh copied, whatever formats and strides they have.
#include <cstring>
#include <functional>

#include <fmt/format.h>
#include <glm/gtc/packing.hpp>

#include "FlatEngine.h"

namespace Lantern
{
namespace
{

using EVertex = ERTModuleVertex;

/// A box from −1 to 1 with corners, normals, tangents, texture coordinates and colours that all formats hold exactly.
struct FBox
{
	std::vector<glm::vec3> Positions, Normals;
	std::vector<glm::vec4> Tangents, Colors;
	std::vector<glm::vec2> UVs;
	std::vector<uint32_t> Indices;

	FBox()
	{
		for (int Face = 0; Face < 6; ++Face)
		{
			const int Axis = Face / 2, U = (Axis + 1) % 3, V = (Axis + 2) % 3;
			const float Sign = Face % 2 == 0 ? 1.0f : -1.0f;
			const uint32_t First = static_cast<uint32_t>(Positions.size());
			for (int Corner = 0; Corner < 4; ++Corner)
			{
				const float A = Corner % 2 == 0 ? 0.0f : 1.0f, B = Corner / 2 == 0 ? 0.0f : 1.0f;
				glm::vec3 Position(0), Normal(0), Tangent(0);
				Position[Axis] = Normal[Axis] = Sign;
				Position[U] = Sign * (2 * A - 1);
				Position[V] = 2 * B - 1;
				Tangent[U] = Sign;
				Positions.push_back(Position);
				Normals.push_back(Normal);
				Tangents.emplace_back(Tangent, Face % 3 == 0 ? -1.0f : 1.0f);
				UVs.emplace_back(A, B);
				Colors.emplace_back(Corner == 0 ? 0.0f : 1.0f, 1.0f, Face == 2 ? 0.0f : 1.0f, 1.0f);
			}
			for (const uint32_t Corner : {0u, 1u, 3u, 0u, 3u, 2u}) { Indices.push_back(First + Corner); }
		}
	}
};

template <class T>
void Append(std::vector<uint8_t>& Out, T Value)
{
	const size_t At = Out.size();
	Out.resize(At + sizeof(T));
	std::memcpy(Out.data() + At, &Value, sizeof(T));
}

uint32_t PackTen(glm::vec4 V, bool bSigned)
{
	const glm::ivec4 Most = bSigned ? glm::ivec4(511, 511, 511, 1) : glm::ivec4(1023, 1023, 1023, 3);
	const glm::uvec4 Fields(glm::ivec4(glm::round(V * glm::vec4(Most))));
	return (Fields.x & 1023u) | (Fields.y & 1023u) << 10 | (Fields.z & 1023u) << 20 | (Fields.w & 3u) << 30;
}

/// With the sign of w in the lowest bit of y.
uint32_t PackOctahedral(glm::vec4 V)
{
	const float Sum = std::abs(V.x) + std::abs(V.y) + std::abs(V.z);
	glm::vec2 P = glm::vec2(V) / Sum;
	if (V.z < 0.0f) { P = (1.0f - glm::abs(glm::vec2(P.y, P.x))) * glm::vec2(P.x >= 0 ? 1 : -1, P.y >= 0 ? 1 : -1); }
	const uint32_t Packed = glm::packSnorm2x16(P) & ~0x10000u;
	return V.w < 0.0f ? Packed | 0x10000u : Packed;
}

/// bDirection: unsigned formats hold −1 to 1.
void Encode(EVertex Format, glm::vec4 V, bool bDirection, std::vector<uint8_t>& Out)
{
	const glm::vec4 Unsigned = bDirection ? 0.5f * V + 0.5f : V;
	switch (Format)
	{
	case EVertex::Float2: return Append(Out, glm::vec2(V));
	case EVertex::Float3: return Append(Out, glm::vec3(V));
	case EVertex::Float4: return Append(Out, V);
	case EVertex::Half2: return Append(Out, glm::packHalf2x16(glm::vec2(V)));
	case EVertex::Half4: return Append(Out, glm::packHalf4x16(V));
	case EVertex::Unorm16x2: return Append(Out, glm::packUnorm2x16(glm::vec2(V)));
	case EVertex::Snorm16x2: return Append(Out, glm::packSnorm2x16(glm::vec2(V)));
	case EVertex::Snorm16x4: return Append(Out, glm::packSnorm4x16(V));
	case EVertex::Unorm8x4: return Append(Out, glm::packUnorm4x8(Unsigned));
	case EVertex::Snorm8x4: return Append(Out, glm::packSnorm4x8(V));
	case EVertex::Bgra8: return Append(Out, glm::packUnorm4x8(glm::vec4(V.z, V.y, V.x, V.w)));
	case EVertex::Unorm10x3: return Append(Out, PackTen(Unsigned, false));
	case EVertex::Snorm10x3: return Append(Out, PackTen(V, true));
	case EVertex::Octahedral16: return Append(Out, PackOctahedral(V));
	}
}

struct FFormats
{
	EVertex Positions = EVertex::Float3, Normals = EVertex::Float3, Tangents = EVertex::Float4, UVs = EVertex::Float2,
	        Colors = EVertex::Unorm8x4;
	bool bInterleaved = true, bIndices16 = false, bSignInNormals = false;
	uint32_t Padding = 0;        ///< bytes behind each vertex
	uint32_t WrongStride = 0;    ///< a planted fault: is added to what the plugin is told
	uint32_t SkippedIndices = 0; ///< before the first
};

class FStreamTest : public FFlatEngineTest
{
protected:
	static constexpr FSignalSet Wanted{ESignal::SunShadow, ESignal::DiffuseGI, ESignal::Reflections};

	void SetUp() override
	{
		FFlatEngineTest::SetUp();
		ASSERT_OK(Device->CreateSampler({}, Sampler.ReleaseAndGetAddress()));
		// Left half opaque and blue at the top, right half transparent at the bottom; normals that lean.
		constexpr uint32_t Colors[4] = {0xff2040ffu, 0xff40ff20u, 0xffff4020u, 0x00ffffffu};
		constexpr uint32_t Leaning[4] = {0xffff8080u, 0xffff80a0u, 0xffff9080u, 0xffff60a0u};
		Map = MakeTexture({2, 2, 1, 1, ERTFormat::RGBA8_SRGB, ERTTextureUsage::Sampled, "Map"}, Colors);
		NormalMap = MakeTexture({2, 2, 1, 1, ERTFormat::RGBA8_UNORM, ERTTextureUsage::Sampled, "NormalMap"}, Leaning);
	}
	void TearDown() override
	{
		Sampler.Reset();
		Map.Reset();
		NormalMap.Reset();
		FFlatEngineTest::TearDown();
	}
	/// A masked material with maps, sun and sky, and boxes of the mesh that AddMesh adds.
	FSignalPicture RenderBoxes(const std::function<ERTMeshHandle(IRTModuleRenderer&)>& AddMesh)
	{
		return Render(
		    [&](IRTModuleRenderer& Renderer) {
			FRTModuleMaterial Desc;
			Desc.BaseColorMap.Texture = Map.Get();
			Desc.NormalMap.Texture = NormalMap.Get();
			Desc.BaseColorMap.Sampler = Desc.NormalMap.Sampler = Sampler.Get();
			Desc.bMasked = Desc.bDoubleSided = true;
			Desc.Emissive[0] = 0.2f;
			ERTMaterialHandle Foliage = ERTMaterialHandle::None;
			ASSERT_OK(Renderer.AddMaterial(Desc, &Foliage));
			const ERTMeshHandle Mesh = AddMesh(Renderer);
			for (const glm::dvec3 At : {glm::dvec3(-1, 0.6, 0), {0.8, 0.8, -0.7}, {0.5, 0.5, 0.9}})
			{
				Place(Renderer, Mesh, Foliage, At, 0.4);
			}
			FRTModuleSun Sun;
			Sun.Direction[0] = 0.4;
			Sun.Irradiance = 3.0f;
			ASSERT_OK(Renderer.SetSun(Sun));
			const float Sky[3] = {0.5f, 0.7f, 1.0f};
			ASSERT_OK(Renderer.SetSky(Sky));
		    },
		    Wanted);
	}
	FSignalPicture RenderCopied()
	{
		return RenderBoxes([&](IRTModuleRenderer& Renderer) {
			std::vector<uint8_t> Colors;
			for (const glm::vec4& Color : Box.Colors) { Append(Colors, glm::packUnorm4x8(Color)); }
			FRTModuleMesh Mesh;
			Mesh.Name = "Copied";
			Mesh.Positions = &Box.Positions[0].x;
			Mesh.Normals = &Box.Normals[0].x;
			Mesh.Tangents = &Box.Tangents[0].x;
			Mesh.UVs = &Box.UVs[0].x;
			Mesh.Colors = Colors.data();
			Mesh.VertexCount = static_cast<uint32_t>(Box.Positions.size());
			Mesh.Indices = Box.Indices.data();
			Mesh.IndexCount = static_cast<uint32_t>(Box.Indices.size());
			// As a mesh on the GPU alone has it.
			Mesh.bKeepOnCpu = false;
			return Add(Renderer, Mesh);
		});
	}
	FSignalPicture RenderStreamed(const FFormats& Formats)
	{
		return RenderBoxes([&](IRTModuleRenderer& Renderer) { return AddStreamed(Renderer, Formats); });
	}
	static ERTMeshHandle Add(IRTModuleRenderer& Renderer, const FRTModuleMesh& Mesh)
	{
		ERTMeshHandle Out = ERTMeshHandle::None;
		const FRTStatus Status = Renderer.AddMesh(Mesh, &Out);
		EXPECT_TRUE(Status.IsOk()) << Status.Message;
		return Out;
	}
	ERTMeshHandle AddStreamed(IRTModuleRenderer& Renderer, const FFormats& Formats)
	{
		FRTModuleStreams Streams;
		struct FPart
		{
			FRTModuleStream& Stream;
			EVertex Format;
			bool bDirection;
			std::function<glm::vec4(size_t)> Get;
		};
		const auto GetNormal = [&](size_t I) { return glm::vec4(Box.Normals[I], Formats.bSignInNormals ? Box.Tangents[I].w : 0.0f); };
		const FPart Parts[] = {
		    {Streams.Positions, Formats.Positions, false, [&](size_t I) { return glm::vec4(Box.Positions[I], 0); }},
		    {Streams.Normals, Formats.Normals, true, GetNormal},
		    {Streams.Tangents, Formats.Tangents, true, [&](size_t I) { return Box.Tangents[I]; }},
		    {Streams.UVs, Formats.UVs, false, [&](size_t I) { return glm::vec4(Box.UVs[I], 0, 0); }},
		    {Streams.Colors, Formats.Colors, false, [&](size_t I) { return Box.Colors[I]; }},
		};
		std::vector<uint8_t> Bytes(16, 0xcd); // vertices begin behind something else
		const auto AddOne = [&](const FPart& Part, size_t Vertex) { Encode(Part.Format, Part.Get(Vertex), Part.bDirection, Bytes); };
		const auto Begin = [&](const FPart& Part) { Part.Stream = {nullptr, Bytes.size(), 0, Part.Format}; };
		const size_t Count = Box.Positions.size();
		for (const FPart& Part : Parts)
		{
			if (Formats.bInterleaved) { break; }
			Begin(Part);
			for (size_t Vertex = 0; Vertex < Count; ++Vertex)
			{
				AddOne(Part, Vertex);
				Bytes.resize(Bytes.size() + Formats.Padding, 0xcd);
			}
			Part.Stream.Stride = static_cast<uint32_t>((Bytes.size() - Part.Stream.Offset) / Count);
		}
		for (size_t Vertex = 0; Formats.bInterleaved && Vertex < Count; ++Vertex)
		{
			for (const FPart& Part : Parts)
			{
				if (Vertex == 0) { Begin(Part); }
				AddOne(Part, Vertex);
			}
			Bytes.resize(Bytes.size() + Formats.Padding, 0xcd);
		}
		const auto Interleaved = static_cast<uint32_t>((Bytes.size() - 16) / Count);
		Bytes.resize(Bytes.size() + 256, 0xcd);
		Buffers.push_back(ImportBytes(Bytes, "EngineVertices"));
		for (const FPart& Part : Parts)
		{
			Part.Stream.Buffer = Buffers.back().Get();
			if (Formats.bInterleaved) { Part.Stream.Stride = Interleaved; }
			Part.Stream.Stride += Formats.WrongStride;
		}
		AddIndices(Formats, Streams);
		FRTModuleMesh Mesh;
		Mesh.Name = "Streamed";
		Mesh.VertexCount = static_cast<uint32_t>(Count);
		Mesh.IndexCount = static_cast<uint32_t>(Box.Indices.size());
		Mesh.BoundsRadius = 1.7320508f * (1.0f + 1e-5f);
		Mesh.Streams = &Streams;
		return Add(Renderer, Mesh);
	}
	void AddIndices(const FFormats& Formats, FRTModuleStreams& Out)
	{
		std::vector<uint8_t> Bytes;
		for (uint32_t I = 0; I < Formats.SkippedIndices; ++I) { Formats.bIndices16 ? Append(Bytes, uint16_t(7)) : Append(Bytes, 7u); }
		Out.IndicesOffset = Bytes.size();
		for (const uint32_t Index : Box.Indices) { Formats.bIndices16 ? Append(Bytes, uint16_t(Index)) : Append(Bytes, Index); }
		Bytes.resize((Bytes.size() + 3) / 4 * 4);
		Buffers.push_back(ImportBytes(Bytes, "EngineIndices"));
		Out.Indices = Buffers.back().Get();
		Out.bIndices16 = Formats.bIndices16;
		Out.bSignInNormals = Formats.bSignInNormals;
	}
	void ExpectSame(const FSignalPicture& Copied, const char* What, const FFormats& Formats, double Tolerance = 0.0)
	{
		const FSignalPicture Streamed = RenderStreamed(Formats);
		const double Difference = Copied.GetMeanDifference(Streamed);
		std::printf("[  figure  ] %s\n", fmt::format("{}: mean difference {:.2e}", What, Difference).c_str());
		EXPECT_LE(Difference, Tolerance) << What;
	}

	const FBox Box;
	TRTRef<IRTSampler> Sampler;
	TRTRef<IRTTexture> Map, NormalMap;
	std::vector<TRTRef<IRTBuffer>> Buffers;
};

TEST_F(FStreamTest, PicturesAreThoseOfCopiedVertices)
{
	const FSignalPicture Copied = RenderCopied();
	for (const ESignal Signal : {ESignal::SunShadow, ESignal::DiffuseGI, ESignal::Reflections})
	{
		EXPECT_GT(Copied.GetMean(Signal), 0.01) << "rays see something";
	}
	// All numbers of the box are exact in these formats.
	ExpectSame(Copied, "float, interleaved", {});
	ExpectSame(Copied, "float, apart, padded, 16-bit indices from an odd place",
	    {.bInterleaved = false, .bIndices16 = true, .Padding = 8, .SkippedIndices = 1});
	ExpectSame(Copied, "half", {EVertex::Half4, EVertex::Half4, EVertex::Half4, EVertex::Half2, EVertex::Half4});
	ExpectSame(Copied, "snorm", {EVertex::Snorm16x4, EVertex::Snorm16x4, EVertex::Snorm16x4, EVertex::Snorm16x2, EVertex::Float4});
	ExpectSame(Copied, "bytes", {EVertex::Half4, EVertex::Snorm8x4, EVertex::Snorm8x4, EVertex::Unorm16x2, EVertex::Bgra8});
	// The sign takes the lowest of 15 bits of the normal.
	ExpectSame(Copied, "octahedral, with the sign in normals",
	    {.Normals = EVertex::Octahedral16, .Tangents = EVertex::Snorm10x3, .bInterleaved = false, .bSignInNormals = true}, 1e-6);
	ExpectSame(Copied, "ten bits", {.Normals = EVertex::Snorm10x3, .Tangents = EVertex::Octahedral16});
	// 0 lies between two steps of these, so that directions lean by up to 0.4 %: what they reflect changes by less.
	ExpectSame(Copied, "unsigned", {.Normals = EVertex::Unorm8x4, .Tangents = EVertex::Unorm10x3}, 0.004);
	Buffers.clear();
}

TEST_F(FStreamTest, AWrongStrideIsSeen)
{
	const FSignalPicture Copied = RenderCopied();
	EXPECT_GT(Copied.GetMeanDifference(RenderStreamed({.WrongStride = 4})), 0.02) << "the comparison tells vertices from others";
	Buffers.clear();
}

} // namespace
} // namespace Lantern

// Classification of triangles: limits of alpha, corners in texels, and the order of indices.
#include "LanternScene/Opacity/OpacityClassifier.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <unordered_map>

#include "LanternCore/Tasks/Tasks.h"
#include "Opacity/OpacityFootprint.h"
#include "Opacity/OpacityFootprintKey.h"

namespace Lantern
{

namespace
{
// Error of filtering and decoding: half a step of 8 bits.
constexpr double TexelMargin = 0.5 / 255.0;
// Error of the interpolated vertex alpha and of the products.
constexpr double ProductMargin = 1.0e-5;
constexpr size_t TrianglesPerTask = 64;

uint64_t Mix(uint64_t Value)
{
	// The finalizer of Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014.
	Value = (Value ^ (Value >> 30)) * 0xbf58476d1ce4e5b9ull;
	Value = (Value ^ (Value >> 27)) * 0x94d049bb133111ebull;
	return Value ^ (Value >> 31);
}

struct FScale
{
	double Low, High; // of what multiplies the texture's alpha
};

FScale MakeScale(float BaseAlpha, uint32_t A, uint32_t B, uint32_t C)
{
	const uint32_t Low = std::min({A >> 24, B >> 24, C >> 24}), High = std::max({A >> 24, B >> 24, C >> 24});
	return {BaseAlpha * (Low / 255.0) * (1.0 - ProductMargin), BaseAlpha * (High / 255.0) * (1.0 + ProductMargin)};
}

bool SurelyPasses(double Scale, double Alpha, float Cutoff) { return Scale * std::max(0.0, Alpha) >= Cutoff; }

bool SurelyFails(double Scale, double Alpha, float Cutoff) { return Scale * std::min(1.0, Alpha) < Cutoff; }

FAlphaLimits MakeLimits(const FScale& Scale, float Cutoff)
{
	// Each condition holds from some alpha on.
	const auto FindFirst = [](auto Holds) {
		int Low = 0, High = 256;
		while (Low < High)
		{
			const int Middle = (Low + High) / 2;
			Holds(Middle) ? High = Middle : Low = Middle + 1;
		}
		return Low;
	};
	FAlphaLimits Limits;
	Limits.PassFrom = FindFirst([&](int A) { return SurelyPasses(Scale.Low, A / 255.0 - TexelMargin, Cutoff); });
	Limits.FailUpTo = FindFirst([&](int A) { return !SurelyFails(Scale.High, A / 255.0 + TexelMargin, Cutoff); }) - 1;
	return Limits;
}

/// Coordinates of a corner, and the greatest terms that they were added up from.
struct FCorner
{
	glm::dvec2 UV, Magnitude;
};

FCorner TransformCorner(const FAlphaTest& Test, const FVertexAttributes& Vertex)
{
	const glm::dvec2 UV(Test.bUV1 ? Vertex.UV1 : Vertex.UV0);
	const glm::dvec4 T(Test.UVTransform);
	const glm::dvec2 Offset(Test.UVOffset);
	const glm::dvec2 Size = glm::abs(UV);
	return {{T.x * UV.x + T.y * UV.y + Offset.x, T.z * UV.x + T.w * UV.y + Offset.y},
	    {std::abs(T.x) * Size.x + std::abs(T.y) * Size.y + std::abs(Offset.x),
	        std::abs(T.z) * Size.x + std::abs(T.w) * Size.y + std::abs(Offset.y)}};
}

EOpacity ClassifyTextured(const FAlphaTest& Test, const FVertexAttributes* const (&Corners)[3])
{
	const FAlphaLimits Limits = MakeAlphaLimits(Test, Corners);
	const FAlphaRange All = Test.Texture->GetRange(Test.Texture->GetLevelCount() - 1, 0, 0);
	if (All.Min >= Limits.PassFrom) { return EOpacity::Opaque; }
	if (All.Max <= Limits.FailUpTo) { return EOpacity::Transparent; }
	FTexelTriangle Triangle;
	return MakeTexelTriangle(Test, Corners, Triangle) ? ClassifyFootprint(Test, Limits, Triangle) : EOpacity::Mixed;
}

template <class TIndex>
FOpacityCounts Reorder(std::span<TIndex> Indices, std::span<const EOpacity> Classes)
{
	assert(Indices.size() == 3 * Classes.size());
	FOpacityCounts Counts;
	for (const EOpacity Class : Classes)
	{
		++(Class == EOpacity::Mixed ? Counts.Mixed : Class == EOpacity::Opaque ? Counts.Opaque : Counts.Transparent);
	}
	const std::vector<TIndex> Source(Indices.begin(), Indices.end());
	size_t Next[3] = {0, 0, 0};
	Next[static_cast<int>(EOpacity::Opaque)] = Counts.Mixed;
	Next[static_cast<int>(EOpacity::Transparent)] = size_t(Counts.Mixed) + Counts.Opaque;
	for (size_t Triangle = 0; Triangle < Classes.size(); ++Triangle)
	{
		const size_t To = Next[static_cast<int>(Classes[Triangle])]++;
		std::copy_n(Source.begin() + static_cast<ptrdiff_t>(3 * Triangle), 3, Indices.begin() + static_cast<ptrdiff_t>(3 * To));
	}
	return Counts;
}
} // namespace

FAlphaLimits MakeAlphaLimits(const FAlphaTest& Test, const FVertexAttributes* const (&Corners)[3])
{
	return MakeLimits(MakeScale(Test.BaseAlpha, Corners[0]->Color, Corners[1]->Color, Corners[2]->Color), Test.Cutoff);
}

bool MakeTexelTriangle(const FAlphaTest& Test, const FVertexAttributes* const (&Corners)[3], FTexelTriangle& Out)
{
	const FAlphaTexels& Texels = Test.Texture->GetTexels();
	for (int I = 0; I < 3; ++I)
	{
		const FCorner Corner = TransformCorner(Test, *Corners[I]);
		Out.P[I] = Corner.UV * glm::dvec2(Texels.Width, Texels.Height);
		Out.Magnitude = glm::max(Out.Magnitude, Corner.Magnitude);
		// The fp32 of the shader overflows here, though fp64 does not.
		if (!(Corner.Magnitude.x < 1.0e30) || !(Corner.Magnitude.y < 1.0e30)) { return false; }
	}
	return true;
}

FAlphaTest MakeAlphaTest(const FMaterialData& Material, const FAlphaPyramid* Texture, const FRTSamplerDesc& Sampler)
{
	FAlphaTest Test;
	Test.bTextured = Material.Textures[TEXTURE_BASE_COLOR] != NO_TEXTURE;
	Test.Texture = Texture;
	Test.AddressU = Sampler.U;
	Test.AddressV = Sampler.V;
	Test.bLinear = Sampler.Mag != ERTFilter::Nearest || Sampler.Min != ERTFilter::Nearest;
	Test.bUV1 = (Material.UVSets & (1u << TEXTURE_BASE_COLOR)) != 0;
	Test.BaseAlpha = Material.BaseColor.a;
	Test.Cutoff = Material.AlphaCutoff;
	Test.UVTransform = Material.UVTransform[TEXTURE_BASE_COLOR];
	Test.UVOffset = Material.UVOffset[TEXTURE_BASE_COLOR];
	return Test;
}

uint64_t MakeOpacityKey(const FMaterialData& Material, uint32_t Program)
{
	uint64_t Key = Mix(Program + 0x9e3779b97f4a7c15ull);
	const auto Add = [&Key](uint32_t Value) { Key = Mix(Key + Value + 0x9e3779b97f4a7c15ull); };
	Add(Material.Flags & MATERIAL_MASKED);
	Add(Material.UVSets & (1u << TEXTURE_BASE_COLOR));
	Add(Material.Textures[TEXTURE_BASE_COLOR]);
	const glm::vec4& T = Material.UVTransform[TEXTURE_BASE_COLOR];
	const glm::vec2& Offset = Material.UVOffset[TEXTURE_BASE_COLOR];
	for (const float Value : {Material.BaseColor.a, Material.AlphaCutoff, T.x, T.y, T.z, T.w, Offset.x, Offset.y})
	{
		Add(std::bit_cast<uint32_t>(Value));
	}
	return Key == 0 ? 1 : Key;
}

EOpacity ClassifyTriangle(const FAlphaTest& Test, const FVertexAttributes& A, const FVertexAttributes& B, const FVertexAttributes& C)
{
	if (!(Test.BaseAlpha >= 0.0f) || (Test.bTextured && !Test.Texture)) { return EOpacity::Mixed; }
	const FScale Scale = MakeScale(Test.BaseAlpha, A.Color, B.Color, C.Color);
	if (!Test.bTextured)
	{
		return SurelyPasses(Scale.Low, 1.0, Test.Cutoff)   ? EOpacity::Opaque
		       : SurelyFails(Scale.High, 1.0, Test.Cutoff) ? EOpacity::Transparent
		                                                   : EOpacity::Mixed;
	}
	return ClassifyTextured(Test, {&A, &B, &C});
}

void ClassifyTriangles(
    const FAlphaTest& Test, const FVertexAttributes* Vertices, std::span<const uint32_t> Indices, std::span<EOpacity> Out)
{
	assert(Indices.size() == 3 * Out.size());
	std::unordered_map<FFootprintKey, uint32_t, FFootprintHash> Known;
	std::vector<uint32_t> Footprints(Out.size()), First;
	for (uint32_t T = 0; T < Out.size(); ++T)
	{
		const FFootprintKey Key = MakeFootprintKey(Test, Vertices, &Indices[3 * size_t(T)]);
		const auto [It, bNew] = Known.try_emplace(Key, static_cast<uint32_t>(First.size()));
		if (bNew) { First.push_back(T); }
		Footprints[T] = It->second;
	}
	std::vector<EOpacity> Classes(First.size());
	ParallelFor(First.size(), TrianglesPerTask, [&](size_t Begin, size_t End) {
		for (size_t I = Begin; I < End; ++I)
		{
			const uint32_t* const C = &Indices[3 * size_t(First[I])];
			Classes[I] = ClassifyTriangle(Test, Vertices[C[0]], Vertices[C[1]], Vertices[C[2]]);
		}
	});
	for (size_t T = 0; T < Out.size(); ++T) { Out[T] = Classes[Footprints[T]]; }
}

FOpacityCounts ReorderByOpacity(std::span<uint32_t> Indices, std::span<const EOpacity> Classes) { return Reorder(Indices, Classes); }

FOpacityCounts ReorderByOpacity(std::span<uint16_t> Indices, std::span<const EOpacity> Classes) { return Reorder(Indices, Classes); }

FOpacityCounts ClassifySection(
    const FAlphaTest& Test, uint64_t Key, const FVertexAttributes* Vertices, uint32_t* Indices, FRTSectionInfo& Section)
{
	assert(!Section.bOpaque && !Section.bProcedural);
	const std::span<uint32_t> Range(Indices + Section.FirstIndex, Section.IndexCount);
	std::vector<EOpacity> Classes(Range.size() / 3);
	ClassifyTriangles(Test, Vertices, Range, Classes);
	const FOpacityCounts Counts = ReorderByOpacity(Range, Classes);
	Section.OpaqueIndexCount = 3 * Counts.Opaque;
	Section.TransparentIndexCount = 3 * Counts.Transparent;
	Section.OpacityKey = Counts.Opaque + Counts.Transparent > 0 ? Key : 0;
	return Counts;
}

} // namespace Lantern

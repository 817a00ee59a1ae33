// Value noise, and the maps of procedural surfaces.
#include "Builtin/ProceduralTextures.h"

#include <cmath>

#include "Builtin/Random.h"
#include "LanternCore/Tasks/Tasks.h"

namespace Lantern::Builtin
{

namespace
{

uint32_t Wrap(int Index, uint32_t Cells)
{
	const int Size = int(Cells);
	return uint32_t((Index % Size + Size) % Size);
}

float Smooth(float T) { return T * T * T * (T * (T * 6.0f - 15.0f) + 10.0f); }

uint8_t ToUnorm(float V) { return uint8_t(glm::clamp(V, 0.0f, 1.0f) * 255.0f + 0.5f); }

/// By table: a power per texel and channel would take longer than all the noise.
uint8_t ToSrgb(float V)
{
	constexpr int Size = 4096;
	static const std::vector<uint8_t> Table = [] {
		std::vector<uint8_t> Values(Size + 1);
		for (int I = 0; I <= Size; ++I)
		{
			const float C = float(I) / Size;
			Values[size_t(I)] = ToUnorm(C <= 0.0031308f ? C * 12.92f : 1.055f * std::pow(C, 1.0f / 2.4f) - 0.055f);
		}
		return Values;
	}();
	return Table[size_t(glm::clamp(V, 0.0f, 1.0f) * float(Size) + 0.5f)];
}

/// One coordinate of a lattice: the cell, the next one, and how far between them.
struct FLatticeStep
{
	uint32_t Cell, Next;
	float Fraction;
};

FLatticeStep FindCell(float X, uint32_t Cells)
{
	const int Truncated = int(X);
	const int Floor = Truncated - (X < float(Truncated) ? 1 : 0);
	const uint32_t Cell = uint32_t(Floor) < Cells ? uint32_t(Floor) : Wrap(Floor, Cells);
	return {Cell, Cell + 1 == Cells ? 0 : Cell + 1, Smooth(X - float(Floor))};
}

} // namespace

float SampleNoise(const glm::vec2& P, uint32_t Cells, uint32_t Seed)
{
	const FLatticeStep X = FindCell(P.x * float(Cells), Cells), Y = FindCell(P.y * float(Cells), Cells);
	const auto At = [&](uint32_t CellX, uint32_t CellY) { return HashToFloat(HashLattice(CellX, CellY, Seed)); };
	return glm::mix(glm::mix(At(X.Cell, Y.Cell), At(X.Next, Y.Cell), X.Fraction),
	    glm::mix(At(X.Cell, Y.Next), At(X.Next, Y.Next), X.Fraction), Y.Fraction);
}

float SampleFractal(const glm::vec2& P, uint32_t Cells, int Octaves, float Gain, uint32_t Seed)
{
	float Sum = 0.0f, Weight = 1.0f, Total = 0.0f;
	for (int I = 0; I < Octaves; ++I)
	{
		Sum += Weight * SampleNoise(P, Cells << I, Seed + uint32_t(I) * 101u);
		Total += Weight;
		Weight *= Gain;
	}
	return Sum / Total;
}

namespace
{

FHostImage MakeImage(const FSurfaceDescription& Description, const char* Suffix, bool bSrgb)
{
	FHostImage Image;
	Image.Name = Description.Name + " " + Suffix;
	Image.Width = Image.Height = Description.Size;
	Image.bSrgb = bSrgb;
	Image.Rgba.resize(size_t(Description.Size) * Description.Size * 4, 255);
	return Image;
}

std::vector<FSurfacePoint> EvaluateAll(const FSurfaceDescription& Description)
{
	const size_t Size = Description.Size;
	std::vector<FSurfacePoint> Points(Size * Size);
	ParallelFor(Size, 16, [&](size_t Begin, size_t End) {
		for (size_t Y = Begin; Y < End; ++Y)
		{
			for (size_t X = 0; X < Size; ++X)
			{
				const glm::vec2 P = (glm::vec2(float(X), float(Y)) + 0.5f) / float(Size);
				Points[Y * Size + X] = Description.Evaluate(P);
			}
		}
	});
	return Points;
}

FHostImage MakeColorMap(const FSurfaceDescription& Description, const std::vector<FSurfacePoint>& Points)
{
	FHostImage Image = MakeImage(Description, "colour", true);
	ParallelFor(Points.size(), 16384, [&](size_t Begin, size_t End) {
		for (size_t I = Begin; I < End; ++I)
		{
			for (int C = 0; C < 3; ++C) { Image.Rgba[I * 4 + size_t(C)] = ToSrgb(Points[I].Albedo[C]); }
			Image.Rgba[I * 4 + 3] = ToUnorm(Points[I].Alpha);
		}
	});
	for (size_t I = 3; I < Image.Rgba.size() && !Image.bHasAlpha; I += 4) { Image.bHasAlpha = Image.Rgba[I] != 255; }
	return Image;
}

FHostImage MakeNormalMap(const FSurfaceDescription& Description, const std::vector<FSurfacePoint>& Points)
{
	FHostImage Image = MakeImage(Description, "normal", false);
	const size_t Size = Description.Size;
	const float Texel = Description.Metres / float(Size);
	const auto At = [&](size_t X, size_t Y) { return Points[(Y % Size) * Size + X % Size].Height; };
	const auto FillRow = [&](size_t Y) {
		for (size_t X = 0; X < Size; ++X)
		{
			const float DX = (At(X + 1, Y) - At(X + Size - 1, Y)) / (2 * Texel);
			const float DY = (At(X, Y + 1) - At(X, Y + Size - 1)) / (2 * Texel);
			// v runs down and the bitangent against it, up: glTF's convention.
			const glm::vec3 N = glm::normalize(glm::vec3(-DX, DY, 1));
			for (int C = 0; C < 3; ++C) { Image.Rgba[(Y * Size + X) * 4 + size_t(C)] = ToUnorm(N[C] * 0.5f + 0.5f); }
		}
	};
	ParallelFor(Size, 16, [&](size_t Begin, size_t End) {
		for (size_t Y = Begin; Y < End; ++Y) { FillRow(Y); }
	});
	return Image;
}

FHostImage MakeRoughnessMap(const FSurfaceDescription& Description, const std::vector<FSurfacePoint>& Points)
{
	FHostImage Image = MakeImage(Description, "roughness", false);
	for (size_t I = 0; I < Points.size(); ++I)
	{
		Image.Rgba[I * 4 + 1] = ToUnorm(Points[I].Roughness);
		Image.Rgba[I * 4 + 2] = ToUnorm(Points[I].Metallic);
	}
	return Image;
}

} // namespace

FHostMaterial MakeSurfaceMaterial(FSceneBuilder& Builder, const FSurfaceDescription& Description)
{
	const std::vector<FSurfacePoint> Points = EvaluateAll(Description);
	FHostMaterial Material;
	Material.Name = Description.Name;
	Material.Slots[TEXTURE_BASE_COLOR].Texture = Builder.AddImage(MakeColorMap(Description, Points));
	if (Description.bNormalMap) { Material.Slots[TEXTURE_NORMAL].Texture = Builder.AddImage(MakeNormalMap(Description, Points)); }
	if (Description.bRoughnessMap)
	{
		Material.Slots[TEXTURE_METALLIC_ROUGHNESS].Texture = Builder.AddImage(MakeRoughnessMap(Description, Points));
	}
	else
	{
		Material.Metallic = Points[0].Metallic;
		Material.Roughness = Points[0].Roughness;
	}
	const float Scale = Description.bUnitUV ? 1.0f : 1.0f / Description.Metres;
	for (FHostTextureSlot& Slot : Material.Slots) { Slot.Transform = {Scale, 0, 0, Scale}; }
	return Material;
}

} // namespace Lantern::Builtin

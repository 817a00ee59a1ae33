// FLandscapePatch: from heights to vertices, and holes.
#include "LandscapePatch.h"

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

#include "LanternRHI/RTText.h"

namespace Lantern
{

namespace
{

/// Part of the extent by which borders reach over into the neighbour: rounding of two transforms must open no crack.
constexpr double Overlap = 1.0 / (1 << 18);

FRTStatus Refuse(const char* Name, const char* Reason)
{
	return FRTStatus::Error(ERTResult::InvalidArgument, "landscape \"%s\": FRTModuleLandscape::%s", FRTShown(Name).Text, Reason);
}

bool IsHole(const uint8_t* Holes, uint32_t Pitch, uint32_t Column, uint32_t Row)
{
	return Holes != nullptr && Holes[size_t(Row) * Pitch + Column] != 0;
}

bool HasQuad(const FRTModuleLandscape& Patch)
{
	const uint32_t Pitch = Patch.HolesPitch != 0 ? Patch.HolesPitch : Patch.Columns - 1;
	for (uint32_t Row = 0; Row + 1 < Patch.Rows; ++Row)
	{
		for (uint32_t Column = 0; Column + 1 < Patch.Columns; ++Column)
		{
			if (!IsHole(Patch.Holes, Pitch, Column, Row)) { return true; }
		}
	}
	return false;
}

/// Where sample Index of Count lies along an axis.
float GetPlace(uint32_t Index, uint32_t Count, float Spacing)
{
	const double Extent = double(Count - 1) * double(Spacing);
	const double Over = Index == 0 ? -Overlap * Extent : (Index + 1 == Count ? Overlap * Extent : 0.0);
	return static_cast<float>(double(Index) * double(Spacing) + Over);
}

} // namespace

FRTStatus CheckLandscape(const FRTModuleLandscape& Patch)
{
	if (Patch.Name == nullptr) { return FRTStatus::Error(ERTResult::InvalidArgument, "FRTModuleLandscape::Name is null"); }
	if (Patch.Heights == nullptr) { return Refuse(Patch.Name, "Heights is null"); }
	if (Patch.Columns < 2 || Patch.Columns > MaxLandscapeSamples) { return Refuse(Patch.Name, "Columns must be 2 to 4097"); }
	if (Patch.Rows < 2 || Patch.Rows > MaxLandscapeSamples) { return Refuse(Patch.Name, "Rows must be 2 to 4097"); }
	if (Patch.RowPitch != 0 && Patch.RowPitch < Patch.Columns) { return Refuse(Patch.Name, "RowPitch is less than Columns"); }
	if (Patch.HolesPitch != 0 && Patch.HolesPitch < Patch.Columns - 1) { return Refuse(Patch.Name, "HolesPitch is less than Columns - 1"); }
	if (!(Patch.SpacingX > 0.0f) || !std::isfinite(Patch.SpacingX)) { return Refuse(Patch.Name, "SpacingX must be finite and above 0"); }
	if (!(Patch.SpacingY > 0.0f) || !std::isfinite(Patch.SpacingY)) { return Refuse(Patch.Name, "SpacingY must be finite and above 0"); }
	if (!std::isfinite(Patch.HeightScale)) { return Refuse(Patch.Name, "HeightScale is not finite"); }
	if (!std::isfinite(Patch.HeightOffset)) { return Refuse(Patch.Name, "HeightOffset is not finite"); }
	const double Highest = std::abs(double(Patch.HeightOffset)) + 65535.0 * std::abs(double(Patch.HeightScale));
	const double Widest = double(MaxLandscapeSamples) * double(std::max(Patch.SpacingX, Patch.SpacingY));
	if (std::max(Highest, Widest) > 1e15) { return Refuse(Patch.Name, "SpacingX, SpacingY, HeightScale or HeightOffset is too large"); }
	return HasQuad(Patch) ? FRTStatus::Success() : Refuse(Patch.Name, "Holes leave nothing");
}

FLandscapePatch::FLandscapePatch(const FRTModuleLandscape& Patch)
    : Name(Patch.Name),
      Columns(Patch.Columns),
      Rows(Patch.Rows),
      SpacingX(Patch.SpacingX),
      SpacingY(Patch.SpacingY),
      HeightScale(Patch.HeightScale),
      HeightOffset(Patch.HeightOffset),
      Heights(size_t(Patch.Columns) * Patch.Rows)
{
	Store({Patch.Heights, 0, 0, Columns, Rows, Patch.RowPitch});
	for (uint32_t Row = 0; Row < Rows; ++Row)
	{
		for (uint32_t Column = 0; Column < Columns; ++Column)
		{
			UVs.push_back(static_cast<float>(Column) / static_cast<float>(Columns - 1));
			UVs.push_back(static_cast<float>(Row) / static_cast<float>(Rows - 1));
		}
	}
	MakeIndices(Patch.Holes, Patch.HolesPitch != 0 ? Patch.HolesPitch : Columns - 1);
}

FRTStatus FLandscapePatch::CheckHeights(const FRTModuleHeights& New) const
{
	const auto Fail = [&](const char* Reason) {
		return FRTStatus::Error(ERTResult::InvalidArgument, "landscape \"%s\": FRTModuleHeights::%s", FRTShown(Name.c_str()).Text, Reason);
	};
	if (New.Heights == nullptr) { return Fail("Heights is null"); }
	if (New.Columns == 0 || New.Columns > Columns) { return Fail("Columns is 0 or above the patch's"); }
	if (New.Rows == 0 || New.Rows > Rows) { return Fail("Rows is 0 or above the patch's"); }
	if (New.FirstColumn > Columns - New.Columns) { return Fail("FirstColumn: the rectangle leaves the patch"); }
	if (New.FirstRow > Rows - New.Rows) { return Fail("FirstRow: the rectangle leaves the patch"); }
	if (New.RowPitch != 0 && New.RowPitch < New.Columns) { return Fail("RowPitch is less than Columns"); }
	return FRTStatus::Success();
}

void FLandscapePatch::Store(const FRTModuleHeights& New)
{
	const uint32_t Pitch = New.RowPitch != 0 ? New.RowPitch : New.Columns;
	for (uint32_t Row = 0; Row < New.Rows; ++Row)
	{
		const uint16_t* const From = New.Heights + size_t(Row) * Pitch;
		std::copy(From, From + New.Columns, Heights.begin() + ptrdiff_t(size_t(New.FirstRow + Row) * Columns + New.FirstColumn));
	}
}

float FLandscapePatch::GetHeight(uint32_t Column, uint32_t Row) const
{
	return HeightOffset + HeightScale * static_cast<float>(Heights[size_t(Row) * Columns + Column]);
}

void FLandscapePatch::MakeVertices()
{
	const size_t Count = size_t(Columns) * Rows;
	Positions.resize(3 * Count);
	Normals.resize(3 * Count);
	size_t At = 0;
	for (uint32_t Row = 0; Row < Rows; ++Row)
	{
		const uint32_t Above = Row > 0 ? Row - 1 : Row, Below = std::min(Row + 1, Rows - 1);
		for (uint32_t Column = 0; Column < Columns; ++Column, At += 3)
		{
			const uint32_t Left = Column > 0 ? Column - 1 : Column, Right = std::min(Column + 1, Columns - 1);
			Positions[At] = GetPlace(Column, Columns, SpacingX);
			Positions[At + 1] = GetPlace(Row, Rows, SpacingY);
			Positions[At + 2] = GetHeight(Column, Row);
			const glm::dvec3 Slope(double(GetHeight(Left, Row)) - double(GetHeight(Right, Row)),
			    double(GetHeight(Column, Above)) - double(GetHeight(Column, Below)), 1.0);
			const glm::dvec3 Run(double(Right - Left) * double(SpacingX), double(Below - Above) * double(SpacingY), 1.0);
			const glm::vec3 Normal(glm::normalize(Slope / Run));
			for (int Axis = 0; Axis < 3; ++Axis) { Normals[At + size_t(Axis)] = Normal[Axis]; }
		}
	}
}

void FLandscapePatch::MakeIndices(const uint8_t* Holes, uint32_t HolesPitch)
{
	for (uint32_t Row = 0; Row + 1 < Rows; ++Row)
	{
		for (uint32_t Column = 0; Column + 1 < Columns; ++Column)
		{
			if (IsHole(Holes, HolesPitch, Column, Row)) { continue; }
			const uint32_t A = Row * Columns + Column, B = A + 1, C = A + Columns, D = C + 1;
			Indices.insert(Indices.end(), {A, B, D, A, D, C}); // counter-clockwise as seen from above
		}
	}
}

FRTModuleMesh FLandscapePatch::MakeMesh()
{
	MakeVertices();
	FRTModuleMesh Mesh;
	Mesh.Name = Name.c_str();
	Mesh.Positions = Positions.data();
	Mesh.Normals = Normals.data();
	Mesh.UVs = UVs.data();
	Mesh.VertexCount = Columns * Rows;
	Mesh.Indices = Indices.data();
	Mesh.IndexCount = static_cast<uint32_t>(Indices.size());
	Mesh.bDeformable = true;
	return Mesh;
}

} // namespace Lantern

// What lights a scene, and the block of constants that passes read.
#include <cassert>
#include <cmath>

#include "LanternScene/Scene/Scene.h"
#include "LanternScene/ShaderTable/SectionTable.h"

namespace Lantern
{

void FRTScene::SetLights(std::vector<FSceneLight> InLights)
{
	Lights = std::move(InLights);
	Facts.Lights = static_cast<uint32_t>(Lights.size());
	bLightsChanged = true;
}

void FRTScene::SetSun(const FSunLight& InSun)
{
	Sun = InSun;
	assert(Sun.Irradiance <= 0.0f || glm::length(Sun.Direction) > 0.0);
	Facts.bSun = Sun.Irradiance > 0.0f;
}

void FRTScene::SetSky(glm::vec3 Radiance)
{
	Sky = Radiance;
	Facts.bSky = glm::any(glm::greaterThan(Sky, glm::vec3(0)));
}

void FRTScene::UpdateLights()
{
	std::vector<FLightData> Data;
	for (const FSceneLight& Light : Lights)
	{
		Data.push_back(Light.Data);
		Data.back().Position = ToRelative(Light.WorldPosition);
	}
	LightData.Assign(std::move(Data));
	bLightsChanged = false;
}

void FRTScene::ListEmissiveObjects()
{
	EmissiveObjects.clear();
	for (uint32_t Index = 0; Index < Objects.size(); ++Index)
	{
		if (Objects[Index].bAlive && Sections.GetRange(Objects[Index].Range).bEmissive) { EmissiveObjects.push_back(Index); }
	}
	bEmissiveObjectsChanged = false;
}

double FRTScene::AddEmissiveTriangles(
    uint32_t Index, double Power, std::vector<FEmissiveTriangle>& Triangles, std::vector<double>& Cumulative) const
{
	const FObject& Object = Objects[Index];
	const FRTGeometryInfo& Info = Object.Info.Geometry->GetInfo();
	const glm::dvec3 Cell = CellCenter(ObjectData[Index].Cell);
	for (uint32_t Section = 0; Section < Info.Sections.size(); ++Section)
	{
		const FMaterialData& Material = Materials[Object.Info.Materials[Section]];
		if ((Sections.Get(FirstSectionOf(Object) + Section).Flags & SECTION_LIGHT) == 0) { continue; }
		for (uint32_t Primitive = 0; Primitive < Info.Sections[Section].IndexCount / 3; ++Primitive)
		{
			glm::vec3 P[3];
			for (int Corner = 0; Corner < 3; ++Corner)
			{
				const uint32_t Vertex = Info.CpuIndices[Info.Sections[Section].FirstIndex + 3 * Primitive + Corner];
				P[Corner] = glm::vec3(glm::dvec3(Object.Info.Transform * glm::dvec4(Info.CpuPositions[Vertex], 1.0)) - Cell);
			}
			const double Area = 0.5 * glm::length(glm::cross(glm::dvec3(P[1] - P[0]), glm::dvec3(P[2] - P[0])));
			if (!(Area > 0.0)) { continue; }
			Power += Area * Material.EmissiveWeight;
			FEmissiveTriangle Triangle{};
			Triangle.P0 = P[0];
			Triangle.P1 = P[1];
			Triangle.P2 = P[2];
			Triangle.Object = Index;
			Triangle.Section = FirstSectionOf(Object) + Section;
			Triangle.Primitive = Primitive;
			Triangle.Flags = ObjectData[Index].Flags & OBJECT_MIRRORED;
			Triangles.push_back(Triangle);
			Cumulative.push_back(Power);
		}
	}
	return Power;
}

void FRTScene::UpdateEmissiveTriangles()
{
	if (bEmissiveObjectsChanged) { ListEmissiveObjects(); }
	std::vector<FEmissiveTriangle> Triangles;
	std::vector<double> Cumulative;
	double Power = 0.0;
	for (const uint32_t Index : EmissiveObjects) { Power = AddEmissiveTriangles(Index, Power, Triangles, Cumulative); }
	EmissivePower = static_cast<float>(Power);
	for (size_t I = 0; I < Triangles.size(); ++I) { Triangles[I].CumulativePower = static_cast<float>(Cumulative[I] / Power); }
	if (!Triangles.empty()) { Triangles.back().CumulativePower = 1.0f; } // rounding must leave no gap above it
	Facts.EmissiveTriangles = static_cast<uint32_t>(Triangles.size());
	EmissiveTriangles.Assign(std::move(Triangles));
	bEmissiveChanged = false;
}

FSceneConstants FRTScene::GetConstants() const
{
	FSceneConstants C{};
	C.Objects = ObjectData.GetAddress();
	C.Sections = Sections.GetTable().GetAddress();
	C.Materials = Materials.GetAddress();
	C.Lights = LightData.GetAddress();
	C.EmissiveTriangles = EmissiveTriangles.GetAddress();
	C.LightCount = LightData.Num();
	C.EmissiveTriangleCount = EmissiveTriangles.Num();
	C.EmissivePower = EmissivePower;
	C.Tlas = Structure ? Structure->GetIndex() : ~0u;
	C.SunDirection = glm::vec3(glm::normalize(Sun.Direction));
	C.SunIrradiance = Sun.Irradiance;
	C.SunColor = Sun.Color;
	// 1 − cos r = 2 sin²(r/2): the difference itself would lose all digits for a disk as small as the sun's.
	const double HalfSin = std::sin(0.25 * double(Sun.AngularDiameter));
	C.SunOneMinusCos = static_cast<float>(2.0 * HalfSin * HalfSin);
	C.SkyRadiance = Sky;
	C.MaterialOverride = SectionContext.Override;
	C.OriginCell = FindCell(Origin);
	C.OriginInCell = glm::vec3(Origin - CellCenter(C.OriginCell));
	C.ObjectReach = Pivots.GetReach();
	C.ObjectMotions = Motions.GetTable().Num() > 0 ? Motions.GetTable().GetAddress() : 0;
	return C;
}

} // namespace Lantern

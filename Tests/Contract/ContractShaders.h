// The shaders of the corpus and the pipelines made of them.
#pragma once

#include "ContractFixture.h"

namespace Lantern
{

/// Mirrors Push in Shaders/Common.glsl.
struct FContractPush
{
	uint64_t Output = 0;
	uint64_t Input = 0;
	uint32_t A = 0, B = 0, C = 0, D = 0, E = 0, F = 0, G = 0, H = 0;
};
static_assert(sizeof(FContractPush) == 48, "scalar layout of Push in Shaders/Common.glsl");

/// Name: the file, for example "Trace.rgen".
FRTShaderCode GetContractShader(const char* Name);

TRTRef<IRTPipeline> MakeComputePipeline(IRTDevice& Device, const char* Shader);
/// Makes a pipeline of Triangle.vert and Colour.frag. If Color is Unknown, it writes depth only.
TRTRef<IRTPipeline> MakeRasterPipeline(
    IRTDevice& Device, ERTFormat Color, ERTFormat Depth = ERTFormat::Unknown, ERTCull Cull = ERTCull::None, bool bDepthWrite = true);

/// Groups of MakeRayPipeline.
enum ERayGroup : uint32_t
{
	GroupTrace,   ///< ray generation
	GroupCall,    ///< ray generation
	GroupMissOne, ///< payload MissOne
	GroupMissTwo, ///< payload MissTwo
	GroupHit,     ///< see Hit.rchit
	GroupMasked,  ///< GroupHit with an any-hit shader that ignores every hit
	GroupDisc,    ///< procedural
	GroupDouble,  ///< callable
	GroupSquare,  ///< callable
};
inline constexpr uint32_t MissOne = 0xf0000001u, MissTwo = 0xf0000002u;

TRTRef<IRTPipeline> MakeRayPipeline(IRTDevice& Device);

/// A shader group by the files of its shaders; null for none.
struct FRayGroup
{
	const char* General = nullptr;
	const char* ClosestHit = nullptr;
	const char* AnyHit = nullptr;
	const char* Intersection = nullptr;
};
/// Makes a monolithic pipeline, a library, or a link of Libraries, with a payload of 4 bytes and recursion 1.
FRTStatus CreateRays(IRTDevice& Device, const std::vector<FRayGroup>& Groups, bool bLibrary, const std::vector<IRTPipeline*>& Libraries,
    const char* Name, TRTRef<IRTPipeline>& Out);
TRTRef<IRTPipeline> MakeRays(IRTDevice& Device, const std::vector<FRayGroup>& Groups, bool bLibrary = false,
    const std::vector<IRTPipeline*>& Libraries = {}, const char* Name = "Rays");

/// gl_RayFlags….
inline constexpr uint32_t RayOpaque = 1, RayNoOpaque = 2, RayFirstHit = 4, RaySkipClosestHit = 8, RayCullBack = 16, RayCullFront = 32,
                          RayCullOpaque = 64, RayCullNoOpaque = 128;

} // namespace Lantern

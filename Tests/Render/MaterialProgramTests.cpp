// Material programs, stand-ins, procedural geometry and callables, as rays of the frame's RTPSO see them: each pixel of a
// wall of quads has the base colour that its program says.
#include "Support/RenderFixture.h"

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternMeasure/MaterialWall.h"
#include "Support/WaitTools.h"

namespace Lantern
{
namespace
{

constexpr uint32_t Columns = 8, Rows = 4, PixelsPerQuad = 8;
constexpr uint32_t Width = Columns * PixelsPerQuad, Height = Rows * PixelsPerQuad;

FShaderSource MakeTrace(bool bCallable)
{
	return MakeMaterialTrace(
	    {.Path = bCallable ? "Test/TraceCallable.rgen" : "Test/Trace.rgen", .RaysPerMetre = PixelsPerQuad, .bCallables = bCallable});
}

FShaderSource MakeCallable(const char* Name, const char* Statement)
{
	FShaderSource Source;
	Source.Path = Name;
	Source.Text = std::string("#version 460\n#extension GL_EXT_ray_tracing : require\n"
	                          "layout(location = 1) callableDataInEXT vec3 Data;\nvoid main() { ") +
	              Statement + " }\n";
	return Source;
}

/// A quad for each material, in rows from the origin; each with the base colour (column / 8, row / 4, 0).
FSceneDescription MakeWall(bool bMasked)
{
	FSceneDescription Scene = MakeMaterialWall({.Count = Columns * Rows, .Columns = Columns});
	for (uint32_t Index = 0; Index < Columns * Rows; ++Index)
	{
		FHostMaterial& Material = Scene.Materials[Index];
		Material.BaseColor = {float(Index % Columns) / Columns, float(Index / Columns) / Rows, 0.0f, 1.0f};
		Material.bDoubleSided = true;
		Material.AlphaMode = bMasked ? EAlphaMode::Mask : EAlphaMode::Opaque;
	}
	return Scene;
}

/// Blue says which program ran.
std::string MakeText(double Blue, const char* More = "")
{
	return fmt::format("#include \"Standard.glsl\"\n"
	                   "FMaterialSurface EvaluateMaterial(FMaterialData M, FMaterialInputs I, uint Override)\n"
	                   "{{\n\tFMaterialSurface S = EvaluateStandard(M, I, Override);\n\tS.BaseColor.b = "
	                   "{:.4f};\n\t{}\n\treturn S;\n}}\n",
	    Blue, More);
}

class FMaterialProgramTest : public FRenderTest
{
protected:
	void LoadWall(bool bMasked = false)
	{
		ASSERT_TRUE(Load(MakeWall(bMasked)));
		SetSky(glm::vec3(0));
		View = LookAt({4, 2, 5}, {4, 2, 0}, 1.0f, Width, Height);
	}
	static FRTScene& World() { return GetScene().GetScene(); }
	static FRenderer& Renderer() { return GetEngine().GetRenderer(); }
	static uint32_t AddProgram(const std::string& Name, std::string Text)
	{
		return Renderer().GetPrograms().Add({.Name = Name, .Text = std::move(Text)});
	}

	/// Traces one frame and reads it back: rgb base colour, a distance.
	void Trace(bool bWait, const std::vector<FShaderSource>& Callables = {})
	{
		FFrameFeatures Features;
		Features.bWaitForPipelines = bWait;
		Features.bRays = true;
		Features.RayGens = {MakeTrace(!Callables.empty())};
		Features.Callables = Callables;
		FConsoleVariables::Get().BeginFrame();
		ASSERT_OK(Renderer().BeginFrame(World(), View, Features));
		FFrameContext& Context = Renderer().GetContext();
		const uint32_t RayGen = Context.RayPipeline ? Context.RayPipeline->FindRayGen(Features.RayGens[0]) : NoRayGen;
		bTraced = RayGen != NoRayGen;
		TRTRef<IRTBuffer> Buffer;
		const FRTBufferDesc Desc{uint64_t(Width) * Height * 16, ERTBufferUsage::CopyDest, ERTMemory::Readback, "Trace"};
		ASSERT_OK(GetDevice().CreateBuffer(Desc, Buffer.ReleaseAndGetAddress()));
		if (bTraced) { AddMaterialTraceReadback(Context, RayGen, Width, Height, Buffer.Get()); }
		ASSERT_OK(Renderer().EndFrame(nullptr));
		ASSERT_OK(Renderer().WaitForAll());
		const auto* const Texels = static_cast<const glm::vec4*>(Buffer->GetMapped());
		Picture.assign(Texels, Texels + size_t(Width) * Height);
	}
	/// Frames that wait for nothing, until Condition holds: as many as the compiler needs, which depends on the machine.
	/// Once it has been idle for some frames running, what is not there will never come.
	void TraceUntil(const std::function<bool()>& Condition)
	{
		constexpr int EnoughIdleFrames = 30;
		int Idle = 0;
		const auto IsOver = [&] { return Condition() || Idle >= EnoughIdleFrames; };
		const auto Frame = [&] {
			ASSERT_NO_FATAL_FAILURE(Trace(false));
			Idle = Renderer().GetRayCompiler().GetStats().bBusy ? 0 : Idle + 1;
		};
		const auto Describe = [&] {
			const FRTPSOCompilerStats& Stats = Renderer().GetRayCompiler().GetStats();
			return fmt::format("{} of {} shader groups compiled, {} pipelines used, {:.1f} s for the last one's first use", Stats.Ready,
			    Stats.Wanted, Stats.Links, 1e-3 * Stats.LastSwapMs);
		};
		Frame();
		ASSERT_TRUE(WaitUntil("material programs", IsOver, Frame, Describe));
		ASSERT_LT(Idle, EnoughIdleFrames) << "never came, and nothing is being compiled";
	}
	glm::vec4 At(uint32_t Index, uint32_t X = PixelsPerQuad / 2, uint32_t Y = PixelsPerQuad / 2) const
	{
		return Picture[size_t(Index / Columns * PixelsPerQuad + Y) * Width + Index % Columns * PixelsPerQuad + X];
	}
	/// Every pixel of quad Index has its own red and green, and this blue; < 0: nothing is seen there.
	void ExpectQuad(uint32_t Index, double Blue)
	{
		for (uint32_t Pixel = 0; Pixel < PixelsPerQuad * PixelsPerQuad; ++Pixel)
		{
			const glm::vec4 Color = At(Index, Pixel % PixelsPerQuad, Pixel / PixelsPerQuad);
			if (Blue < 0.0)
			{
				ASSERT_LT(Color.a, 0.0f) << "quad " << Index;
				continue;
			}
			ASSERT_NEAR(Color.r, float(Index % Columns) / Columns, 1e-4) << "quad " << Index;
			ASSERT_NEAR(Color.g, float(Index / Columns) / Rows, 1e-4) << "quad " << Index;
			ASSERT_NEAR(Color.b, Blue, 1e-4) << "quad " << Index;
			ASSERT_NEAR(Color.a, 5.0f, 1e-4) << "quad " << Index;
		}
	}

	FView View;
	std::vector<glm::vec4> Picture;
	bool bTraced = false;
};

TEST_F(FMaterialProgramTest, EachQuadRunsItsOwnProgram)
{
	ASSERT_NO_FATAL_FAILURE(LoadWall());
	for (uint32_t Index = 1; Index < Columns * Rows; ++Index)
	{
		World().SetMaterialProgram(Index, AddProgram("Own" + std::to_string(Index), MakeText(Index / 64.0)));
	}
	for (const char* Libraries : {"1", "0"})
	{
		SetVariable("r.RT.Pipeline.Libraries", Libraries);
		ASSERT_NO_FATAL_FAILURE(Trace(true));
		for (uint32_t Index = 0; Index < Columns * Rows; ++Index)
		{
			ASSERT_NO_FATAL_FAILURE(ExpectQuad(Index, Index / 64.0)) << "libraries " << Libraries;
		}
	}
}

TEST_F(FMaterialProgramTest, StandInsServeUntilProgramsAreThere)
{
	ASSERT_NO_FATAL_FAILURE(LoadWall());
	ASSERT_NO_FATAL_FAILURE(TraceUntil([&] { return bTraced; }));
	std::vector<FHitProgram> Programs;
	for (uint32_t Index = 0; Index < Columns * Rows; ++Index)
	{
		Programs.push_back({AddProgram("Late" + std::to_string(Index), MakeText(0.5 + Index / 128.0)), ERTHitClass::Opaque});
		World().SetMaterialProgram(Index, Programs.back().Program);
	}
	const auto IsReady = [&](FHitProgram Program) { return Renderer().GetRayPipeline()->GetState(Program) == ERTHitState::Ready; };
	// In every frame each quad shows its own colour or the stand-in's, just as the frame's RTPSO says; there are no holes.
	ASSERT_NO_FATAL_FAILURE(TraceUntil([&] {
		for (uint32_t Index = 0; Index < Programs.size() && !HasFatalFailure(); ++Index)
		{
			ExpectQuad(Index, IsReady(Programs[Index]) ? 0.5 + Index / 128.0 : 0.0);
		}
		return HasFatalFailure() || std::all_of(Programs.begin(), Programs.end(), IsReady);
	}));
}

TEST_F(FMaterialProgramTest, SkippedOnesAreLeftOutUntilTheyAreThere)
{
	ASSERT_NO_FATAL_FAILURE(LoadWall());
	SetVariable("r.RT.Pipeline.Fallback", "0");
	ASSERT_NO_FATAL_FAILURE(TraceUntil([&] { return bTraced && At(5).a > 0.0f && !Renderer().GetRayCompiler().GetStats().bBusy; }));
	const FHitProgram Program{AddProgram("Skipped", MakeText(0.75)), ERTHitClass::Opaque};
	World().SetMaterialProgram(5, Program.Program);
	ASSERT_NO_FATAL_FAILURE(TraceUntil([&] {
		const bool bReady = Renderer().GetRayPipeline()->GetState(Program) == ERTHitState::Ready;
		ExpectQuad(5, bReady ? 0.75 : -1.0);
		ExpectQuad(6, 0.0);
		return bReady || HasFatalFailure();
	}));
}

TEST_F(FMaterialProgramTest, RaysThatHitAStandInAreCounted)
{
	ASSERT_NO_FATAL_FAILURE(LoadWall());
	const uint32_t Broken = AddProgram("BrokenForEver", "nonsense\n");
	for (const uint32_t Index : {3u, 9u, 10u}) { World().SetMaterialProgram(Index, Broken); }
	const auto GetHits = [&] {
		const std::vector<FProgramPriority>& Priorities = Renderer().GetProgramPriorities();
		return Broken < Priorities.size() ? Priorities[Broken].StandInHits : 0u;
	};
	ASSERT_NO_FATAL_FAILURE(TraceUntil([&] { return bTraced && GetHits() > 0; }));
	EXPECT_EQ(GetHits(), 3u * PixelsPerQuad * PixelsPerQuad);
	EXPECT_NEAR(Renderer().GetProgramPriorities()[Broken].Distance, glm::distance(glm::dvec3(3, 0, 0), View.Position), 3.0);
	ExpectQuad(3, 0.0);
	// Nothing to count where everything is there.
	World().SetMaterialProgram(3, StandardProgram);
	World().SetMaterialProgram(9, StandardProgram);
	World().SetMaterialProgram(10, StandardProgram);
	ASSERT_NO_FATAL_FAILURE(Trace(true));
	ExpectQuad(3, 0.0);
}

TEST_F(FMaterialProgramTest, AlphaTestsAreTheProgramsOwn)
{
	ASSERT_NO_FATAL_FAILURE(LoadWall(true));
	// By opacity: the left half of the quad is cut away.
	World().SetMaterialProgram(1, AddProgram("HalfOpacity", MakeText(0.25, "S.Opacity = I.UV0.x < 0.5 ? 0.0 : 1.0;")));
	// By a test of its own: the upper half.
	World().SetMaterialProgram(2,
	    AddProgram("HalfTest", MakeText(0.25) + "#define MATERIAL_HAS_ALPHA_TEST\n"
	                                            "bool IsHitCutAway(FMaterialRef Materials, FSectionData Section, uint Primitive, vec2 B)\n"
	                                            "{ return FetchMaterialInputs(Section, Primitive, B).UV0.y > 0.5; }\n"));
	// The standard's, as it is.
	World().SetMaterialProgram(3, AddProgram("Plain", "#define MATERIAL_STANDARD_OPACITY\n" + MakeText(0.25)));
	ASSERT_NO_FATAL_FAILURE(Trace(true));
	ExpectQuad(0, 0.0);
	ExpectQuad(3, 0.25);
	constexpr uint32_t Early = 1, Late = PixelsPerQuad - 2;
	EXPECT_LT(At(1, Early, Early).a, 0.0f);
	EXPECT_NEAR(At(1, Late, Early).b, 0.25f, 1e-4);
	EXPECT_NEAR(At(2, Early, Early).b, 0.25f, 1e-4);
	EXPECT_LT(At(2, Early, Late).a, 0.0f);
}

TEST_F(FMaterialProgramTest, EditIsSeenAndABadEditIsNot)
{
	ASSERT_NO_FATAL_FAILURE(LoadWall());
	const uint32_t Program = AddProgram("Edited", MakeText(0.125));
	World().SetMaterialProgram(7, Program);
	ASSERT_NO_FATAL_FAILURE(Trace(true));
	ExpectQuad(7, 0.125);
	Renderer().GetPrograms().Edit(Program, {.Name = "Edited", .Text = MakeText(0.875)});
	ASSERT_NO_FATAL_FAILURE(Trace(true));
	ExpectQuad(7, 0.875);
	Renderer().GetPrograms().Edit(Program, {.Name = "Edited", .Text = "nonsense\n"});
	ASSERT_NO_FATAL_FAILURE(Trace(true));
	ExpectQuad(7, 0.875);
}

TEST_F(FMaterialProgramTest, RasterAndRaysRunTheSameProgram)
{
	FSceneDescription Wall = MakeWall(false);
	for (FHostMaterial& Material : Wall.Materials) { Material.BaseColor = glm::vec4(1.0f, 0.5f, 0.0f, 1.0f); }
	for (const uint32_t Index : {10u, 12u, 21u}) { Wall.Materials[Index].Program = "Materials/Checker.glsl"; }
	ASSERT_TRUE(Load(std::move(Wall)));
	SetSky(glm::vec3(0));
	constexpr uint32_t Size = 64;
	View = LookAt({4, 2, 5}, {4, 2, 0}, 1.0f, Size, Size);
	ASSERT_NO_FATAL_FAILURE(Trace(true));
	TRTRef<IRTBuffer> Buffer;
	const FRTBufferDesc Desc{Size * Size * 4, ERTBufferUsage::CopyDest, ERTMemory::Readback, "BaseColor"};
	ASSERT_OK(GetDevice().CreateBuffer(Desc, Buffer.ReleaseAndGetAddress()));
	GetEngine().ExtraPasses = [&](FFrameContext& Context, const FGBuffer& GBuffer, const FFrameOutputs&) {
		const FGraphBuffer Readback = Context.Graph.ImportBuffer(Buffer.Get(), ERTAccess::None, ERTAccess::HostRead, "BaseColor");
		Context.Graph.AddPass("ReadBaseColor", [&](FPassBuilder& Builder) -> FPassExecute {
			Builder.Read(GBuffer.BaseColor, ERTAccess::CopyRead);
			Builder.Write(Readback, ERTAccess::CopyWrite);
			return [=](FPassContext& Pass) {
				Pass.Commands().CopyTextureToBuffer(Pass.GetBuffer(Readback), 0, Pass.GetTexture(GBuffer.BaseColor), 0, 0);
			};
		});
	};
	ASSERT_OK(GetEngine().RenderFrame(View, 0.0, {}, nullptr));
	ASSERT_OK(Renderer().WaitForAll());
	const auto* const Bytes = static_cast<const uint8_t*>(Buffer->GetMapped());
	uint32_t Dark = 0;
	for (uint32_t Index = 0; Index < Columns * Rows; ++Index)
	{
		for (const glm::vec2 Place : {glm::vec2(0.25f, 0.25f), glm::vec2(0.75f, 0.25f), glm::vec2(0.25f, 0.75f), glm::vec2(0.75f, 0.75f)})
		{
			const glm::vec2 World = glm::vec2(Index % Columns, Index / Columns) + Place;
			const glm::vec2 Ndc = (World - glm::vec2(4, 2)) / (5.0f * std::tan(0.5f));
			const glm::ivec2 Pixel((Ndc.x + 1.0f) * 0.5f * Size, (1.0f - Ndc.y) * 0.5f * Size);
			if (Pixel.x < 0 || Pixel.x >= int(Size)) { continue; }
			const bool bDark = Bytes[(size_t(Pixel.y) * Size + size_t(Pixel.x)) * 4] < 200;
			const glm::vec4 Traced = At(Index, uint32_t(Place.x * PixelsPerQuad), uint32_t(Place.y * PixelsPerQuad));
			ASSERT_EQ(bDark, Traced.r < 0.5f) << "quad " << Index << " at " << Place.x << ", " << Place.y;
			Dark += bDark;
		}
	}
	EXPECT_EQ(Dark, 6u) << "half of the squares of three quads";
}

TEST_F(FMaterialProgramTest, CallablesAreCalledByTheirIndex)
{
	ASSERT_NO_FATAL_FAILURE(LoadWall());
	ASSERT_NO_FATAL_FAILURE(Trace(true, {MakeCallable("First", "Data.b = 0.25;"), MakeCallable("Second", "Data.b = 0.5;")}));
	for (uint32_t Index = 0; Index < Columns * Rows; ++Index) { ExpectQuad(Index, Index % Columns < Columns / 2 ? 0.25 : 0.5); }
}

TEST_F(FMaterialProgramTest, ProceduralGeometryHasTheShapeOfItsProgram)
{
	ASSERT_NO_FATAL_FAILURE(LoadWall());
	// A ball of radius 2 before the wall, in a box.
	const float Box[6] = {2, 0, 0, 6, 4, 4};
	FRTGeometryInfo Info;
	Info.Name = "Ball";
	const FRTBufferDesc Desc{sizeof(Box), ERTBufferUsage::Storage | ERTBufferUsage::GeometryInput, ERTMemory::Upload, "Ball"};
	ASSERT_OK(GetDevice().CreateBuffer(Desc, Info.Aabbs.ReleaseAndGetAddress()));
	std::memcpy(Info.Aabbs->GetMapped(), Box, sizeof(Box));
	FRTSectionInfo Section;
	Section.IndexCount = 1;
	Section.bProcedural = true;
	Info.Sections.push_back(Section);
	FRTGeometryRef Geometry;
	ASSERT_OK(World().CreateGeometry(std::move(Info), Geometry));
	FMaterialData Material = World().GetMaterials()[0];
	Material.BaseColor = glm::vec4(0.5f, 0.5f, 0.0f, 1.0f);
	const uint32_t Program =
	    Renderer().GetPrograms().Add({.Name = "Ball", .Text = MakeText(0.625), .IntersectionPath = "Rays/Ellipsoid.rint"});
	FRTObjectInfo Object;
	Object.Geometry = Geometry;
	Object.Materials = {World().AddMaterial(Material, Program)};
	World().AddObject(std::move(Object));
	ASSERT_NO_FATAL_FAILURE(Trace(true));
	for (uint32_t Y = 0; Y < Height; ++Y)
	{
		for (uint32_t X = 0; X < Width; ++X)
		{
			const glm::vec2 Place = (glm::vec2(X, Y) + 0.5f) / float(PixelsPerQuad) - glm::vec2(4, 2);
			const float Below = 4.0f - glm::dot(Place, Place);
			const glm::vec4 Color = Picture[size_t(Y) * Width + X];
			ASSERT_NEAR(Color.b, Below > 0.0f ? 0.625f : 0.0f, 1e-4) << X << ", " << Y;
			ASSERT_NEAR(Color.a, Below > 0.0f ? 5.0f - 2.0f - std::sqrt(Below) : 5.0f, 1e-3) << X << ", " << Y;
		}
	}
}

} // namespace
} // namespace Lantern

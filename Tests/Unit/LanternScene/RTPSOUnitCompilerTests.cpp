// The compile of one unit, on the mock: libraries, SPIR-V, shaders in common, edits.
#include "Pipelines/RTPSOUnitCompiler.h"

#include <thread>

#include "RTPSOTestTools.h"

namespace Lantern
{
namespace
{

using ::testing::HasSubstr;

class FUnitCompilerTest : public FPipelineTest
{
protected:
	FUnitJob MakeJob(FPipelineUnit Unit, bool bLibrary, bool bEmptyGroup = false)
	{
		return {std::move(Unit), 1, ++Jobs, bLibrary, bEmptyGroup, 16, Shared};
	}
	FUnitResult Compile(const FUnitJob& Job) { return FUnitCompiler(*Device, *Compiler).Compile(Job); }

	std::shared_ptr<FSharedShaders> Shared = std::make_shared<FSharedShaders>();
	uint64_t Jobs = 0;
};

TEST_F(FUnitCompilerTest, ALibraryHoldsTheGroupAndWhereAskedAnEmptyOne)
{
	for (const bool bEmptyGroup : {false, true})
	{
		Device->Mock().ClearCalls();
		const FUnitResult Result = Compile(MakeJob(MakeMissUnit(Wanted, 0), true, bEmptyGroup));
		ASSERT_TRUE(Result.Status) << Result.Status.Message;
		ASSERT_TRUE(Result.Build);
		EXPECT_EQ(Result.Build->Id, Jobs);
		EXPECT_EQ(Result.Build->bEmptyGroup, bEmptyGroup);
		EXPECT_TRUE(Result.Build->Library);
		EXPECT_TRUE(Result.Build->Codes.empty());
		const auto Calls = Device->Mock().FindCalls(ERTMockCall::CreateRayTracingPipeline, "SHADOW.miss");
		ASSERT_EQ(Calls.size(), 1u);
		EXPECT_EQ(Calls[0].Numbers[1], bEmptyGroup ? 2u : 1u);
		EXPECT_EQ(Calls[0].Numbers[3], 16u) << "payload";
		EXPECT_EQ(Calls[0].Numbers[5], 1u) << "is a library";
	}
}

TEST_F(FUnitCompilerTest, WithoutALibraryTheDriverIsNotAsked)
{
	const FUnitResult Result = Compile(MakeJob(MakeHitUnit(Wanted, 1, Masked(StandardProgram), *Programs), false));
	ASSERT_TRUE(Result.Status) << Result.Status.Message;
	EXPECT_FALSE(Result.Build->Library);
	ASSERT_EQ(Result.Build->Codes.size(), 2u) << "closest hit and alpha test";
	EXPECT_FALSE(Result.Build->Codes[0]->Words.empty());
	EXPECT_EQ(Result.Build->Stages, (std::vector{ERTShaderStage::ClosestHit, ERTShaderStage::AnyHit}));
	EXPECT_TRUE(Device->GetAsked().empty());
}

TEST_F(FUnitCompilerTest, AFailureHasNoBuildAndSaysWhere)
{
	const uint32_t Broken = Programs->Add({.Name = "Broken", .Text = "float Value() { return\n wrong; }\n"});
	const FUnitResult Glslang = Compile(MakeJob(MakeHitUnit(Wanted, 1, Opaque(Broken), *Programs), true));
	EXPECT_EQ(Glslang.Status.Code, ERTResult::CompileFailed);
	EXPECT_THAT(Glslang.Status.Message, HasSubstr("Materials/Broken.glsl:2:"));
	EXPECT_FALSE(Glslang.Build);
	EXPECT_TRUE(Device->GetAsked().empty());
	Device->Mock().FailCompile("SHADOW.miss");
	const FUnitResult Driver = Compile(MakeJob(MakeMissUnit(Wanted, 0), true));
	EXPECT_EQ(Driver.Status.Code, ERTResult::CompileFailed);
	EXPECT_FALSE(Driver.Build);
	EXPECT_FALSE(Driver.ContentKey.empty()) << "so that an edit is noticed";
}

TEST_F(FUnitCompilerTest, ShadersInCommonAreCompiledOnce)
{
	constexpr int Threads = 4;
	const FShaderSource Source = MakeMissUnit(Wanted, 0).GetSource(0);
	std::vector<FShaderBinaryRef> Binaries(Threads);
	std::vector<std::thread> Compiling;
	for (FShaderBinaryRef& Binary : Binaries)
	{
		Compiling.emplace_back([&] { EXPECT_TRUE(Shared->Get(*Compiler, Source, 1, Binary)); });
	}
	for (std::thread& Thread : Compiling) { Thread.join(); }
	for (const FShaderBinaryRef& Binary : Binaries) { EXPECT_EQ(Binary, Binaries[0]); }
	EXPECT_EQ(Compiler->GetStats().Compiled, 1u);
	FShaderBinaryRef Newer;
	EXPECT_TRUE(Shared->Get(*Compiler, Source, 2, Newer));
	EXPECT_NE(Newer, Binaries[0]) << "another version";
}

TEST_F(FUnitCompilerTest, TheContentKeyFollowsEditsOfIncludedFiles)
{
	const FUnitCompiler Units(*Device, *Compiler);
	const FPipelineUnit Hit = MakeHitUnit(Wanted, 1, Opaque(StandardProgram), *Programs), Miss = MakeMissUnit(Wanted, 0);
	const std::string HitKey = Units.GetContentKey(Hit), MissKey = Units.GetContentKey(Miss);
	EXPECT_EQ(Units.GetContentKey(Hit), HitKey);
	Folder.Write("Materials/Material.glsl", "float Value() { return 3.0; }\n");
	EXPECT_NE(Units.GetContentKey(Hit), HitKey);
	EXPECT_EQ(Units.GetContentKey(Miss), MissKey);
}

} // namespace
} // namespace Lantern

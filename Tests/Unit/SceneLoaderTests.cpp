// The scenes of others, as the loader gives them.
#include <chrono>
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include "LanternHost/BuiltinScenes.h"
#include "LanternHost/SceneLoader.h"

namespace Lantern
{
namespace
{

std::string GetScenePath(const std::string& Relative)
{
	const char* Folder = std::getenv("LANTERN_SCENES");
	return (Folder != nullptr ? std::filesystem::path(Folder)
							  : std::filesystem::path(LANTERN_SOURCE_DIR) / "../shared/scenes") /
		   Relative;
}

TEST(SceneLoader, Timing)
{
	for (const char* Name : {"black_forest/black_forest.gltf", "sponza/Sponza.gltf", "brainstem/BrainStem.glb",
							 "cornell/cornell.gltf", "roughness/scene.gltf"})
	{
		const auto Start = std::chrono::steady_clock::now();
		const FLoadResult Result = LoadScene(GetScenePath(Name));
		const double Seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - Start).count();
		ASSERT_TRUE(Result.Scene) << Result.Error;
		size_t Triangles = 0;
		for (const FHostMesh& Mesh : Result.Scene->Meshes)
		{
			Triangles += Mesh.Indices.size() / 3;
		}
		glm::dvec3 Min(0), Max(0);
		GetSceneBounds(*Result.Scene, EvaluatePose(*Result.Scene, 0), Min, Max);
		printf("%s: %.2f s, %zu nodes %zu triangles %zu images [%g %g %g] [%g %g %g]\n", Name, Seconds,
			   Result.Scene->Nodes.size(), Triangles, Result.Scene->Images.size(), Min.x, Min.y, Min.z, Max.x, Max.y,
			   Max.z);
		for (const std::string& Warning : Result.Scene->Warnings)
		{
			printf("  %s\n", Warning.c_str());
		}
	}
}

TEST(SceneLoader, Builtins)
{
	for (const FBuiltinSceneInfo& Info : GetBuiltinScenes())
	{
		const FLoadResult Result = LoadScene(Info.Name);
		EXPECT_TRUE(Result.Scene) << Result.Error;
	}
}

} // namespace
} // namespace Lantern

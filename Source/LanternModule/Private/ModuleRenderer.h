// IRTModuleRenderer: calls from any thread (FSceneCalls), and frames over FRTScene and FRenderer.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "AheadLists.h"
#include "ArgumentChecks.h"
#include "LanternModule/Module.h"
#include "LanternRHICommon/RefCounted.h"
#include "LanternRenderer/Frame.h"
#include "LanternRenderer/HostProjection.h"
#include "LanternRenderer/HostSurface.h"
#include "LanternScene/Memory/BufferUploads.h"
#include "LanternScene/Scene/Scene.h"
#include "ModuleWorld.h"
#include "SceneCalls.h"
#include "SceneState.h"

namespace Lantern
{

class FModuleRenderer final : public TRefCounted<IRTModuleRenderer>
{
public:
	/// Owner outlives the renderer: the library must not go while it is in use.
	FModuleRenderer(IRTModule& InOwner, IRTDevice& InDevice, const FModuleWorld& InWorld, FRendererDesc Desc);
	~FModuleRenderer() override;

	FRTStatus AddMaterial(const FRTModuleMaterial& Material, ERTMaterialHandle* Out) override { return Calls.AddMaterial(Material, Out); }
	FRTStatus SetMaterial(ERTMaterialHandle Handle, const FRTModuleMaterial& Material) override
	{
		return Calls.SetMaterial(Handle, Material);
	}
	FRTStatus RemoveMaterial(ERTMaterialHandle Handle) override { return Calls.RemoveMaterial(Handle); }
	FRTStatus AddMesh(const FRTModuleMesh& Mesh, ERTMeshHandle* Out) override { return Calls.AddMesh(Mesh, Out); }
	FRTStatus AddLandscape(const FRTModuleLandscape& Patch, ERTMeshHandle* Out) override { return Calls.AddLandscape(Patch, Out); }
	FRTStatus SetLandscapeHeights(ERTMeshHandle Handle, const FRTModuleHeights& Heights) override
	{
		return Calls.SetLandscapeHeights(Handle, Heights);
	}
	FRTStatus UpdateMeshVertices(ERTMeshHandle Handle, const float* Positions, const float* Normals) override
	{
		return Calls.UpdateMeshVertices(Handle, Positions, Normals);
	}
	FRTStatus GetMeshBuffer(ERTMeshHandle Handle, FRTModuleMeshBuffer* Out) override { return Calls.GetMeshBuffer(Handle, Out); }
	FRTStatus MarkMeshDeformed(ERTMeshHandle Handle) override { return Calls.MarkMeshDeformed(Handle); }
	FRTStatus RemoveMesh(ERTMeshHandle Handle) override { return Calls.RemoveMesh(Handle); }
	FRTStatus AddObject(const FRTModuleObject& Object, ERTObjectHandle* Out) override
	{
		return Out != nullptr ? Calls.AddObjects(&Object, 1, Out) : RefuseNull("AddObject", "Out");
	}
	FRTStatus AddObjects(const FRTModuleObject* Objects, uint32_t Count, ERTObjectHandle* Out) override
	{
		return Calls.AddObjects(Objects, Count, Out);
	}
	FRTStatus SetObjectTransform(ERTObjectHandle Handle, const double Transform[12]) override
	{
		return Calls.SetObjectTransform(Handle, Transform);
	}
	FRTStatus SetObjectMaterials(ERTObjectHandle Handle, const ERTMaterialHandle* Handles, uint32_t Count) override
	{
		return Calls.SetObjectMaterials(Handle, Handles, Count);
	}
	FRTStatus SetObjectMesh(ERTObjectHandle Handle, ERTMeshHandle Mesh, const ERTMaterialHandle* Handles, uint32_t Count) override
	{
		return Calls.SetObjectMesh(Handle, Mesh, Handles, Count);
	}
	FRTStatus SetObjectCastsShadow(ERTObjectHandle Handle, bool bCastsShadow) override
	{
		return Calls.SetObjectCastsShadow(Handle, bCastsShadow);
	}
	FRTStatus SetObjectVisible(ERTObjectHandle Handle, bool bVisible) override { return Calls.SetObjectVisible(Handle, bVisible); }
	FRTStatus SetObjectToon(ERTObjectHandle Handle, const FRTModuleToon* Toon) override { return Calls.SetObjectToon(Handle, Toon); }
	FRTStatus SetObjectChannels(ERTObjectHandle Handle, uint8_t Channels) override { return Calls.SetObjectChannels(Handle, Channels); }
	FRTStatus AddLight(const FRTModuleLight& Light, ERTLightHandle* Out) override { return Calls.AddLight(Light, Out); }
	FRTStatus SetLight(ERTLightHandle Handle, const FRTModuleLight& Light) override { return Calls.SetLight(Handle, Light); }
	FRTStatus RemoveLight(ERTLightHandle Handle) override { return Calls.RemoveLight(Handle); }
	FRTStatus AddIesProfile(const FRTModuleIesProfile& Profile, ERTIesHandle* Out, FRTModuleIesInfo* Info) override
	{
		return Calls.AddIesProfile(Profile, Out, Info);
	}
	FRTStatus RemoveIesProfile(ERTIesHandle Handle) override { return Calls.RemoveIesProfile(Handle); }
	FRTStatus RemoveObject(ERTObjectHandle Handle) override { return Calls.RemoveObject(Handle); }
	FRTStatus SetSun(const FRTModuleSun& Sun) override { return Calls.SetSun(Sun); }
	FRTStatus SetSky(const float Radiance[3]) override { return Calls.SetSky(Radiance); }
	FRTStatus SetSkyMap(const FRTModuleSkyMap* Map) override { return Calls.SetSkyMap(Map); }
	FRTStatus SetSkyProgram(const FRTModuleSkyProgram* Program) override { return Calls.SetSkyProgram(Program); }
	FRTStatus Precache(const FRTModuleFrame& Frame, FRTModuleProgress Progress, void* User) override;
	FRTStatus RenderFrame(const FRTModuleFrame& Frame, FRTModuleOutputs* Out) override;
	FRTStatus EndFrame(FRTFence* OutFence) override;
	FRTStatus Recreate(IRTDevice* NewDevice, const FRTModuleMeshSource& Source) override;

private:
	/// What a frame's views are to the renderer.
	struct FFrameViews
	{
		FView View;
		std::optional<FView> Previous;
		FHostSurface Surface; ///< its textures are not imported yet
	};

	FFrameFeatures MakeFeatures(const FRTModuleFrame& Frame, bool bHostSurface) const;
	FRTStatus ReadViews(const FRTModuleFrame& Frame, FFrameViews& Out) const;
	/// OutAhead: the fence of what was submitted ahead of Frame.Commands, or 0.
	FRTStatus RecordFrame(const FRTModuleFrame& Frame, const FFrameViews& Views, FRTFence& OutAhead);
	FRTStatus RecordAhead(const FRTModuleFrame& Frame, const FFrameViews& Views, FRTFence& OutAhead);
	FRTStatus AddPasses(const FRTModuleFrame& Frame, const FFrameViews& Views);
	FRTModuleFog MakeFog() const;
	FRTModuleIndirectVolume MakeIndirectVolume() const;
	FRTModuleWait MakeWait() const;
	void TakeOver();
	void HandToEngine(const FFrameOutputs& Made);
	void ReleaseOutputs();

	TRTRef<IRTModule> Owner;
	/// All that goes when its device is lost.
	struct FOnDevice
	{
		FOnDevice(IRTDevice& InDevice, FRendererDesc Desc);
		~FOnDevice();
		TRTRef<IRTDevice> Device;
		FRTScene Scene;
		FRenderer Renderer;
		FBufferUploads Uploads;
		FSceneState State;
		FAheadLists AheadLists;
	};
	/// Notes a loss of the device, and says it once.
	FRTStatus Watch(FRTStatus Status);

	/// Fails if another thread is in a frame or in Recreate.
	FRTStatus Enter(const char* Function, std::unique_lock<std::mutex>& Out);

	std::mutex FrameMutex; ///< held in RenderFrame, EndFrame and Recreate, and never waited for
	const FModuleWorld World;
	const FRendererDesc Desc;
	std::unique_ptr<FOnDevice> On;
	FSceneCalls Calls;
	bool bLost = false;                                  ///< nothing is done until Recreate
	std::vector<FSceneCommand> Commands;                 ///< taken over by this frame
	bool bArrivalsLeft = false;                          ///< for later frames
	TRTRef<IRTCommandList> Recorded;                     ///< between RenderFrame and EndFrame
	std::array<TRTRef<IRTTexture>, SignalCount> Outputs; ///< of the last frame
	struct
	{
		TRTRef<IRTTexture> Visibility, Light;
		FFogGrid Grid{};
	} Fog; ///< of the last frame
	struct
	{
		TRTRef<IRTTexture> Light, Moment;
		FFogGrid Grid{};
	} IndirectVolume; ///< of the last frame
	struct
	{
		TRTRef<IRTTexture> Visibility, Lights;
	} LightMask; ///< of the last frame
	struct
	{
		TRTRef<IRTTexture> Light, Transmittance, Looks;
	} Transmission;     ///< of the last frame
	FRTFence Ahead = 0; ///< what the recorded frame's submission waits for
	uint32_t FrameIndex = 0;
};

} // namespace Lantern

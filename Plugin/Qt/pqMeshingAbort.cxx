// SPDX-License-Identifier: BSD-3-Clause
#include "pqMeshingAbort.h"

#include <pqApplicationCore.h>
#include <pqCoreUtilities.h>
#include <pqPipelineSource.h>
#include <pqProgressManager.h>
#include <pqProgressWidget.h>
#include <pqServer.h>
#include <pqServerManagerModel.h>

#include <vtkAlgorithm.h>
#include <vtkSMProxy.h>

#include <QCoreApplication>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QTimer>
#include <QToolButton>

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <memory>

namespace
{
constexpr std::array<const char*, 8> OurFilters = { "LabelMesher", "LabelSplit", "Tighten", "IndicatorReconstruct",
  "SizingField", "ParticleSampleCells", "DelaunayLabelMesh", "GridLabelMesh" };

vtkAlgorithm* AlgorithmOf(pqPipelineSource* source)
{
  return vtkAlgorithm::SafeDownCast(source->getProxy()->GetClientSideObject());
}

/// The filters of ours that are at work in this process.
std::vector<pqPipelineSource*> FindRunning()
{
  std::vector<pqPipelineSource*> running;
  const auto* model = pqApplicationCore::instance()->getServerManagerModel();
  for (pqPipelineSource* source : model->findItems<pqPipelineSource*>())
  {
    const char* const name = source->getProxy()->GetXMLName();
    const bool ours = std::any_of(
      OurFilters.begin(), OurFilters.end(), [&](const char* filter) { return name && std::strcmp(name, filter) == 0; });
    vtkAlgorithm* const algorithm = ours && !source->getServer()->isRemote() ? AlgorithmOf(source) : nullptr;
    if (algorithm && algorithm->GetProgress() > 0 && algorithm->GetProgress() < 1)
    {
      running.push_back(source);
    }
  }
  return running;
}

/// Calls a function the next time that a source has been applied.
void OnceApplied(pqPipelineSource* source, const std::function<void()>& then)
{
  const auto connection = std::make_shared<QMetaObject::Connection>();
  *connection = QObject::connect(source, &pqProxy::modifiedStateChanged, source,
    [=]()
    {
      if (source->modifiedState() == pqProxy::UNMODIFIED)
      {
        QObject::disconnect(*connection);
        then();
      }
    });
}

bool IsInput(QEvent::Type type)
{
  constexpr std::array<QEvent::Type, 18> kinds = { QEvent::MouseButtonPress, QEvent::MouseButtonRelease,
    QEvent::MouseButtonDblClick, QEvent::MouseMove, QEvent::Wheel, QEvent::KeyPress, QEvent::KeyRelease,
    QEvent::Shortcut, QEvent::ShortcutOverride, QEvent::ContextMenu, QEvent::DragEnter, QEvent::DragMove, QEvent::Drop,
    QEvent::FileOpen, QEvent::Close, QEvent::Quit, QEvent::TouchBegin, QEvent::InputMethod };
  return std::find(kinds.begin(), kinds.end(), type) != kinds.end();
}
}

pqMeshingAbort::pqMeshingAbort(QObject* parent)
  : QObject(parent)
{
}

void pqMeshingAbort::startup()
{
  pqProgressManager* const progress = pqApplicationCore::instance()->getProgressManager();
  QObject::connect(progress, SIGNAL(progress(const QString&, int)), this, SLOT(lookAtEvents()));
  QObject::connect(progress, SIGNAL(enableProgress(bool)), this, SLOT(enableButton(bool)));
}

void pqMeshingAbort::shutdown()
{
  QObject::disconnect(pqApplicationCore::instance()->getProgressManager(), nullptr, this, nullptr);
}

void pqMeshingAbort::lookAtEvents()
{
  if (!this->Running.empty())
  {
    return; // we are at it
  }
  this->Running = FindRunning();
  if (this->Running.empty())
  {
    return;
  }
  if (!this->Button)
  {
    QWidget* const window = pqCoreUtilities::mainWidget();
    auto* const widget = window ? window->findChild<pqProgressWidget*>() : nullptr;
    this->Button = widget ? widget->abortButton() : nullptr;
  }
  this->enableButton(true);
  QCoreApplication::instance()->installEventFilter(this);
  QCoreApplication::processEvents();
  QCoreApplication::instance()->removeEventFilter(this);
  this->Running.clear();
}

void pqMeshingAbort::enableButton(bool atWork)
{
  const bool enable = atWork && !this->Running.empty();
  if (this->Button && this->Button->isEnabled() != enable)
  {
    pqApplicationCore::instance()->getProgressManager()->setEnableAbort(enable);
  }
}

bool pqMeshingAbort::eventFilter(QObject*, QEvent* event)
{
  if (event->type() == QEvent::MouseButtonPress && this->Button)
  {
    const QPoint at = static_cast<QMouseEvent*>(event)->globalPos();
    if (this->Button->rect().contains(this->Button->mapFromGlobal(at)))
    {
      this->stop();
    }
  }
  else if (event->type() == QEvent::KeyPress && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape)
  {
    this->stop();
  }
  return event->type() == QEvent::Timer || IsInput(event->type());
}

void pqMeshingAbort::stop()
{
  for (pqPipelineSource* const source : this->Running)
  {
    if (AlgorithmOf(source)->GetAbortExecute())
    {
      continue;
    }
    AlgorithmOf(source)->SetAbortExecute(1);
    // The Apply that started the filter, which is still at work, then one that the user presses.
    const auto allow = [source]()
    {
      AlgorithmOf(source)->SetAbortExecute(0);
      source->getProxy()->MarkDirty(nullptr); // no property has changed
      source->renderAllViews();
    };
    const auto offer = [source, allow]()
    {
      source->setModifiedState(pqProxy::MODIFIED);
      OnceApplied(source, allow);
    };
    if (source->modifiedState() == pqProxy::UNMODIFIED)
    {
      QTimer::singleShot(0, source, offer);
    }
    else
    {
      OnceApplied(source, [source, offer]() { QTimer::singleShot(0, source, offer); });
    }
  }
}

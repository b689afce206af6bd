// SPDX-License-Identifier: BSD-3-Clause
// Stops filters of LabelMesh from the application: by the button beside the progress bar, or by Escape.
//
// ParaView 5.11 has the button, but nobody listens to it, and no event is looked at while a filter works. So at each
// step of progress of a filter of ours, with the built-in server, this looks at what the window system has to say, and
// drops all of it but the button and the key. Timers wait: what they start may want the very data that are being made.
//
// VTK runs an aborted filter again at the next update, which is the next picture. So it stays aborted, with nothing in
// its output, until Apply, which can be pressed again, also when no property has changed.
#ifndef pqMeshingAbort_h
#define pqMeshingAbort_h

#include <QObject>
#include <QPointer>

#include <vector>

class QWidget;
class pqPipelineSource;

class pqMeshingAbort : public QObject
{
  Q_OBJECT

public:
  explicit pqMeshingAbort(QObject* parent = nullptr);

  void startup();
  void shutdown();

protected:
  bool eventFilter(QObject* object, QEvent* event) override;

private Q_SLOTS:
  void lookAtEvents();
  void enableButton(bool atWork);

private:
  void stop();

  std::vector<pqPipelineSource*> Running; ///< while events are looked at
  QPointer<QWidget> Button;
};

#endif
